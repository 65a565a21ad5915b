from __future__ import annotations

import json

import numpy as np
import pandas as pd

from towtank.cfd.case_loads import CaseLoads, LoadChoices
from towtank.core.conventions import Conventions
from towtank.report.cfd_history_outputs import history_files, joined_overview, write_histories


def history(case: str, name: str) -> CaseLoads:
    return CaseLoads(
        case,
        np.array([0.1, 0.2]),
        "time",
        {"p_0": np.array([1.0, 2.0])},
        Conventions(force_scaling="dimensional"),
        units={"p_0": "Pa"},
        history=name,
    )


def test_files_are_named_after_case_and_history_and_never_collide():
    assert history_files([history("beta 4", "gauges/p"), history("b", "p")]) == ["beta_4-gauges_p.csv", "b-p.csv"]
    assert history_files([history("a", "x/p"), history("A", "x p")]) == ["a-x_p-1.csv", "A-x_p-2.csv"]


def test_folder_holds_overview_tables_and_provenance(tmp_path):
    items = [history("one", "gauges/p"), history("two", "gauges/p")]
    overview = joined_overview([pd.DataFrame({"case": [item.name], "history": [item.history]}) for item in items])
    written = write_histories(overview, items, LoadChoices(), tmp_path / "out")
    assert [path.name for path in written] == [
        "histories.csv",
        "one-gauges_p.csv",
        "two-gauges_p.csv",
        "provenance.json",
    ]
    listed = pd.read_csv(tmp_path / "out" / "histories.csv")
    table = pd.read_csv(tmp_path / "out" / listed.loc[1, "file"])
    assert table.to_dict("list") == {"time [s]": [0.1, 0.2], "p_0 [Pa]": [1.0, 2.0]}
    told = json.loads((tmp_path / "out" / "provenance.json").read_text())
    assert set(told["cases"]) == {"one/gauges/p", "two/gauges/p"}
