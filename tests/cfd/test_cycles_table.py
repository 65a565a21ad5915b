from __future__ import annotations

import numpy as np
import pytest

from towtank.cfd.case_loads import LoadChoices
from towtank.cfd.case_sweep import find_cases
from towtank.cfd.cycles_table import cycles_table
from towtank.cfd.settled_loads import settle_sweep

TIME = 0.1 * np.arange(1, 401)


def test_one_row_a_cycle_of_periodic_loads_only(case):
    wave = np.cos(2.0 * np.pi * TIME / 4.0)
    noise = 1e-3 * np.random.default_rng(0).standard_normal(TIME.size)
    folder = case("pure", x=10.0 + 3.0 * wave + noise, y=2.0 + 0.0 * TIME)
    table = cycles_table(settle_sweep(find_cases([folder]), LoadChoices(axes="x-forward-z-down")))
    of_x = table[table["load"] == "X"]
    assert of_x["cycle"].tolist() == list(range(1, 11))
    assert of_x["amplitude 1"].to_numpy() == pytest.approx(3.0, abs=0.01)
    assert set(of_x["unit"]) == {"N"}
    assert "Y" not in set(table["load"])


def test_steady_cases_have_no_cycles(case):
    noise = 0.1 * np.random.default_rng(0).standard_normal(TIME.size)
    settled = settle_sweep(find_cases([case("steady", x=10.0 + noise)]), LoadChoices())
    assert cycles_table(settled).empty
