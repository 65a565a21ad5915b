import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core import Conventions, DerivativeSet, Provenance, Ship
from towtank.core.derivative_set import joined
from towtank.core.errors import ReadError, TermError

SHIP = Ship("hull", L=3.0, B=0.4, T=0.14, volume=0.086)


def make(values=(-0.3, -0.15), **more):
    return DerivativeSet.from_values("s", SHIP, dict(zip(("Yv", "Nv"), values)), Conventions(), **more)


finite = st.floats(allow_nan=False, allow_infinity=False, width=64)


@given(
    values=st.tuples(finite, finite), cov=st.floats(0, 1e3), dof=st.one_of(st.floats(1, 1e6), st.just(math.inf))
)
def test_json_round_trip_is_bit_for_bit(values, cov, dof):
    start = make(values, covariance=np.eye(2) * cov, dof=dof, validity={"v": (-0.3, 0.3)}, reference_speed=1.5)
    back = DerivativeSet.from_json(start.to_json())
    assert back.values.tobytes() == start.values.tobytes()
    assert back.covariance.tobytes() == start.covariance.tobytes()
    assert (back.dof, back.conventions, back.ship, back.terms) == (dof, start.conventions, SHIP, start.terms)
    assert back.validity == {"v": (-0.3, 0.3)}


def test_json_file_round_trip_and_atomic_write(tmp_path):
    path = tmp_path / "derivatives.json"
    make(provenance=Provenance(source="table 1", misprints=("x",))).to_json(path)
    assert DerivativeSet.from_json(path).provenance.misprints == ("x",)
    assert [p.name for p in tmp_path.iterdir()] == ["derivatives.json"]


@pytest.mark.parametrize("text", ["{}", '{"format": "x"}', "{bad", "[1]"])
def test_files_that_are_not_sets_are_refused(tmp_path, text):
    path = tmp_path / "bad.json"
    path.write_text(text)
    with pytest.raises(ReadError) as caught:
        DerivativeSet.from_json(path)
    assert str(path) in str(caught.value)


def test_missing_file_and_incomplete_set(tmp_path):
    with pytest.raises(ReadError, match="not found"):
        DerivativeSet.from_json(tmp_path / "none.json")
    data = json.loads(make().to_json())
    del data["terms"][0]["factors"]
    with pytest.raises(ReadError, match="incomplete"):
        DerivativeSet.from_dict(data)


def test_intervals_use_student_t():
    s = make(covariance=np.diag([0.01, 0.04]), dof=5.0)
    interval = s.conf_int()
    assert interval.loc["Yv", "upper"] == pytest.approx(-0.3 + 2.570581835636314 * 0.1)


def test_table_has_the_promised_columns():
    assert list(make().to_frame()) == ["name", "value", "std", "lower95", "upper95", "scaling"]


def test_unknown_name_lists_the_known():
    with pytest.raises(TermError, match="Yv, Nv"):
        make()["Yr"]


def test_values_cannot_be_changed_in_place():
    with pytest.raises(ValueError, match="read-only"):
        make().values[0] = 1.0


def test_force_is_scaled_by_length_draught_and_speed():
    force = make().forces({"surge": 1.0, "v": -0.1, "r": 0.0})
    unit = 0.5 * 1025 * 3.0 * 0.14 * 1.01
    assert force["Y"] == pytest.approx(-0.3 * -0.1 / math.sqrt(1.01) * unit)
    assert force["N"] == pytest.approx(-0.15 * -0.1 / math.sqrt(1.01) * unit * 3.0)


def test_moment_about_another_origin_comes_back_to_midship():
    at = Conventions(origin=0.1)
    s = DerivativeSet.from_values("s", SHIP, {"Yv": -0.3, "Nv": -0.15}, at)
    force = s.forces({"surge": 1.0, "v": -0.1, "r": 0.0})
    alone = DerivativeSet.from_values("s", SHIP, {"Yv": -0.3, "Nv": -0.15}, Conventions()).forces(
        {"surge": 1.0, "v": -0.1, "r": 0.0}
    )
    assert force["N"] == pytest.approx(alone["N"] + 0.3 * alone["Y"])


def test_extrapolation_is_said():
    s = make(validity={"v": (-0.2, 0.2)})
    assert s.extrapolates(v=(-0.1, 0.3))
    assert s.extrapolates(v=(-0.2, 0.2)) == []


def test_summary_and_latex_name_the_scaling():
    s = make(covariance=np.diag([1e-6, 4e-6]))
    assert "0.5 rho L T U^2" in s.summary()
    assert "-0.3000" in s.summary()
    assert "\\begin{tabular}" in s.to_latex()


def test_joined_sets_keep_their_covariance():
    both = joined(
        [make(covariance=np.eye(2)).subset(["Yv"]), make(covariance=4 * np.eye(2)).subset(["Nv"])], "both"
    )
    assert both.covariance.tolist() == [[1.0, 0.0], [0.0, 4.0]]


def test_excel_holds_table_covariance_and_conventions(tmp_path):
    import pandas as pd

    path = tmp_path / "s.xlsx"
    make(covariance=np.eye(2)).to_excel(path)
    sheets = pd.read_excel(path, sheet_name=None)
    assert set(sheets) == {"derivatives", "covariance", "conventions"}
    assert sheets["derivatives"]["value"].tolist() == [-0.3, -0.15]
