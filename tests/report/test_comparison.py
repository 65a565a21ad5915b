"""Two sets side by side."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ConventionError
from towtank.core.ship import Ship
from towtank.datasets import load_set
from towtank.report import compare_sets, comparison_text, read_set
from towtank.report.comparison import COLUMNS

SHIP = Ship("model", L=4.0, B=0.6, T=0.25, mass=200.0, rho=1000.0)


def made(values: dict[str, float], sd: float | None = None, ship: Ship = SHIP, **choices: str) -> DerivativeSet:
    derivatives = DerivativeSet.from_values("made", ship, values, HOME.but(**choices))
    return derivatives if sd is None else replace(derivatives, covariance=sd**2 * np.eye(len(values)))


def test_dtc_drift_model_tests_against_cfd() -> None:
    # MASHCON 2019, planar motion of the Duisburg Test Case, Table 7
    comparison = compare_sets(load_set("dtc-drift-efd"), load_set("dtc-drift-cfd-63"))
    assert list(comparison.columns) == list(COLUMNS)
    row = comparison.set_index("name").loc["Yv"]
    assert row["(B-A)/A [%]"] == pytest.approx(60.02, abs=0.01)
    assert row["(A-B)/A [%]"] == pytest.approx(-60.02, abs=0.01)
    assert row["|B-A|/|A| [%]"] == pytest.approx(60.02, abs=0.01)
    assert row["verdict"] == "no uncertainty given"
    assert comparison.attrs["n"] == 7
    a, b = comparison["A"].to_numpy(), comparison["B"].to_numpy()
    assert comparison.attrs["Q"] == pytest.approx(math.sqrt(np.mean(((a - b) / a) ** 2)), rel=1e-12)
    assert comparison.attrs["BS"] == int(np.sign(a - b).sum())


def test_the_second_set_is_converted() -> None:
    a = made({"Yv": -0.30, "Nv": -0.10}, sd=0.01)
    comparison = compare_sets(a, a.to("prime"))
    np.testing.assert_allclose(comparison["B"], comparison["A"], rtol=1e-13)
    np.testing.assert_allclose(comparison["B_std"], 0.01, rtol=1e-13)
    assert comparison["verdict"].tolist() == ["agree", "agree"]
    assert comparison.attrs["mean_z2"] == pytest.approx(0.0, abs=1e-20)


def test_z_and_verdicts() -> None:
    a = made({"Yv": -0.30, "Yr": 0.05, "Nv": -0.10, "Nr": 0.0}, sd=0.003)
    b = made({"Yv": -0.305, "Yr": 0.062, "Nv": -0.15, "Nr": 0.001}, sd=0.004)
    comparison = compare_sets(a, b)
    np.testing.assert_allclose(comparison["z"], [-1.0, 2.4, -10.0, 0.2], rtol=1e-9)
    assert comparison["verdict"].tolist() == ["agree", "doubtful", "differ", "agree, A is zero"]
    assert math.isnan(comparison["(B-A)/A [%]"].iloc[3])
    assert comparison.attrs["n"] == 3


def test_one_known_uncertainty_stands_alone() -> None:
    comparison = compare_sets(made({"Yv": -0.30}), made({"Yv": -0.315}, sd=0.01))
    assert comparison["z"].iloc[0] == pytest.approx(-1.5)
    assert comparison["verdict"].iloc[0] == "agree, uncertainty of A unknown"
    other = compare_sets(made({"Yv": -0.30}, sd=0.01), made({"Yv": -0.315}))
    assert other["verdict"].iloc[0] == "agree, uncertainty of B unknown"


def test_terms_meet_by_meaning_and_strangers_are_listed() -> None:
    comparison = compare_sets(
        made({"R0": 0.02, "Yv": -0.3, "Nv": -0.1}), made({"X0": -0.022, "Yv": -0.3, "Yr": 0.05})
    )
    table = comparison.set_index("name")
    assert table.loc["R0", "B"] == 0.022
    assert comparison.attrs["only_a"] == ["Nv"]
    assert comparison.attrs["only_b"] == ["Yr"]
    assert table.loc["Nv", "verdict"] == "only in A"
    assert table.loc["Yr", ["B", "verdict"]].tolist() == [0.05, "only in B"]
    assert math.isnan(table.loc["Yr", "A"])


def test_the_first_set_is_converted_when_the_second_cannot_be() -> None:
    a = made({"Yv": -0.3, "Yr": 0.05, "Yvdot": -0.1, "Xudot": -0.01})
    b = made({"Yv": -0.3, "Yr": 0.05, "Yvdot": -0.1}, added_mass_coriolis="inside")
    comparison = compare_sets(a, b)
    assert "A was converted to the conventions of B" in comparison.attrs["notes"][0]
    assert comparison.set_index("name").loc["Yr", "A"] == pytest.approx(0.05 - 0.01)


def test_sets_without_a_common_term_or_convention_are_refused() -> None:
    with pytest.raises(ConventionError, match="no derivative in common"):
        compare_sets(made({"Yv": -0.3}), made({"Nv": -0.1}))
    bis = replace(made({"Yv": -0.3}), conventions=HOME.but(force_scaling="bis"))
    with pytest.raises(ConventionError, match="cannot be brought into the conventions"):
        compare_sets(made({"Yv": -0.3}), bis)


def test_model_and_ship_are_compared_without_dimensions() -> None:
    model = made({"Yv": -0.3}, ship=replace(SHIP, scale=50.0))
    comparison = compare_sets(model, model.at_scale(1))
    assert comparison["B"].tolist() == [-0.3]
    dimensional = replace(model, reference_speed=1.0).to("dimensional")
    turned = compare_sets(dimensional, dimensional.at_scale(1))
    np.testing.assert_allclose(turned["B"], turned["A"], rtol=1e-12)


def test_a_table_without_ship_takes_the_other_ship(tmp_path: Path) -> None:
    path = tmp_path / "cfd.csv"
    path.write_text("name,value,scaling\nYv,-0.02,L2\n", encoding="utf-8")
    comparison = compare_sets(made({"Yv": -0.30}), read_set(path))
    assert comparison["B"].iloc[0] == pytest.approx(-0.02 * 4.0 / 0.25)
    assert comparison.attrs["notes"] == ["B does not say its ship: taken as model"]


def test_text_table_has_the_digits_of_the_uncertainty_and_the_totals() -> None:
    a = made({"Yv": -0.30, "Nv": -0.10}, sd=0.004)
    text = comparison_text(compare_sets(a, made({"Yv": -0.33, "Nv": -0.11, "Yr": 0.05}, sd=0.003)))
    line = next(row for row in text.splitlines() if row.startswith("Yv"))
    assert line.split() == [
        "Yv", "-0.3000", "0.0040", "-0.3300", "0.0030", "-0.0300", "+10.0", "-10.0", "10.0", "-6.0", "differ",
    ]  # fmt: skip
    assert "Q = 0.100" in text
    assert "BS = +2/2" in text
    assert "only in B: Yr" in text
    widths = {len(row) for row in text.splitlines() if set(row) == {"-"}}
    assert len(widths) == 1
