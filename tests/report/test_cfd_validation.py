"""Tables, figure, page and folder of a validation."""

import json
import math

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError
from towtank.report.cfd_validation_figures import WIDEST, validation_figure
from towtank.report.cfd_validation_outputs import (
    ValidationHeading,
    render_cfd_validation,
    require_cfd_validation_folder,
    write_cfd_validation,
)
from towtank.report.cfd_validation_tables import (
    error_table,
    validation_records,
    validation_table,
    validation_text,
    validation_totals,
)
from towtank.verify import validate_table

HEADING = ValidationHeading(
    "ours against <theirs>", "CFD", "tank", inputs={"S.csv": "0" * 64}, notes=("a remark",)
)


@pytest.fixture
def validation():
    def table(rows):
        return pd.DataFrame(rows, columns=["quantity", "value", "uncertainty", "unit"])

    simulation = [("Ct", 4.53, 0.11, ""), ("heave", 0.194, 0.004, "mm"), ("trim", -1.05, math.nan, "mm/m")]
    data = [
        ("Ct", 5.22, 0.2, ""),
        ("heave", 0.19, 0.005, "mm"),
        ("trim", -0.83, 0.1, "mm/m"),
        ("zero", 0.0, 0.1, ""),
    ]
    return validate_table(table([*simulation, ("zero", 0.3, 0.1, ""), ("only", 1.0, 0.1, "")]), table(data))


def test_the_page_tables_have_a_row_for_each_quantity_and_shade_what_is_not_validated(validation):
    verdicts = validation_table(validation)
    assert [row[0] for row in verdicts.rows] == ["Ct", "heave", "trim", "zero"]
    assert verdicts.marks == ("weak", "", "", "weak")
    errors = error_table(validation)
    assert [column.title for column in errors.columns[1:5]] == ["S−D", "D−S", "(S−D)/D [%]", "(D−S)/D [%]"]
    assert errors.rows[0][3].strip() == "−13.22"
    assert errors.rows[3][3].strip() == "–"


def test_totals_count_verdicts_and_name_what_stands_apart(validation):
    totals = validation_totals(validation)
    assert totals[0] == "4 quantities: 1 validated, 2 not validated, 1 not judged"
    assert totals[1].startswith("Q = 0.171")
    assert "only in the simulation: only" in totals
    assert "without an error in per cent, and not in Q and BS, since D is zero: zero" in totals


def test_the_text_has_every_convention_and_a_sentence_for_each_verdict(validation):
    text = validation_text(validation)
    for name in ("S-D", "D-S", "(S-D)/D [%]", "(D-S)/D [%]"):
        assert name in text
    assert "Ct: not validated: |E| = 0.69 (13.2 % of D) exceeds U_V = 0.2283" in text
    assert "heave: validated at level U_V = 0.006403 mm" in text
    assert "not judged, U_SN is unknown: trim" in text


def test_plain_data_hold_no_nan(validation):
    data = validation_records(validation)
    text = json.dumps(data, allow_nan=False)
    assert json.loads(text)["quantities"][2]["U_V"] is None
    assert data["coverage"] == 2.0


def test_bars_are_the_validation_uncertainty_and_reach_zero_when_validated(validation):
    ax = validation_figure(validation)
    assert [label.get_text() for label in ax.get_yticklabels()] == ["Ct", "heave", "trim"]
    assert ax.get_ylim()[0] > ax.get_ylim()[1]
    spans = {container.get_label(): container for container in ax.containers}
    assert set(spans) == {"validated", "not validated", "not judged: an uncertainty is unknown"}
    (bar,) = spans["validated"].lines[2][0].get_segments()
    assert bar[0][0] < 0.0 < bar[1][0]
    (bar,) = spans["not validated"].lines[2][0].get_segments()
    np.testing.assert_allclose(bar[:, 0], 100.0 * np.array([-0.69 - 0.22825, -0.69 + 0.22825]) / 5.22, rtol=1e-3)


def test_errors_beyond_the_edge_are_printed(validation):
    wide = validation.copy()
    wide.attrs = validation.attrs
    wide.loc[0, "S-D"] = 20.0
    ax = validation_figure(wide)
    assert [text.get_text() for text in ax.texts] == ["+383 %"]
    assert ax.get_xlim()[1] <= 1.09 * WIDEST


def test_the_page_is_escaped_and_complete(validation):
    page = render_cfd_validation(validation, HEADING)
    assert "ours against &lt;theirs&gt;" in page
    assert "<svg" in page
    assert "not judged, U_SN is unknown: trim" in page
    assert "a remark" in page
    assert "0" * 64 in page


def test_the_folder_is_complete_and_keeps_to_its_kind(validation, tmp_path):
    out = tmp_path / "validation"
    written = write_cfd_validation(validation, out, HEADING)
    assert [path.name for path in written] == [
        "validation.csv",
        "validation.json",
        "report.html",
        "provenance.json",
    ]
    back = pd.read_csv(out / "validation.csv")
    np.testing.assert_array_equal(back["U_V"], validation["U_V"])
    assert back["verdict"].tolist() == validation["verdict"].tolist()
    provenance = json.loads((out / "provenance.json").read_text())
    assert provenance["inputs"] == {"S.csv": "0" * 64}
    assert provenance["coverage factor"] == 2.0
    (out / "provenance.json").write_text('{"format": "towtank manoeuvres 1"}')
    with pytest.raises(TowtankError, match="results of another kind"):
        require_cfd_validation_folder(out)


def test_without_report_there_is_none(validation, tmp_path):
    written = write_cfd_validation(validation, tmp_path / "v", HEADING, report=False)
    assert "report.html" not in [path.name for path in written]
