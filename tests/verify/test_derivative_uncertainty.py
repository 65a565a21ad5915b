"""Derivatives on several grids: numerical uncertainty beside and with that of the fit."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import ConventionError, TowtankError
from towtank.datasets import load_set
from towtank.verify import METHODS, derivative_uncertainty

H = (1.0, 1.4, 1.96)
SET = load_set("dtmb5512-sway-efd")
FIT = np.diag((0.01 * SET.values) ** 2)
FIT[0, 1] = FIT[1, 0] = 0.5 * 0.01**2 * SET.values[0] * SET.values[1]


def grids(p=2.0, covariance=None):
    return [replace(SET, values=SET.values * (1.0 + 0.02 * h**p), covariance=covariance) for h in H]


def test_power_laws_give_every_derivative_its_order_and_limit():
    found = derivative_uncertainty(grids(1.5), H)
    assert list(found.table["name"]) == list(SET.names)
    assert found.table["order"].to_numpy() == pytest.approx([1.5] * len(SET))
    assert found.table["extrapolated"].to_numpy() == pytest.approx(SET.values)
    assert set(found.table["method"]) == {"factor of safety"}
    assert len(found.methods) == len(METHODS) * len(SET)


def test_covariance_is_that_of_the_fit_plus_half_of_u_squared():
    found = derivative_uncertainty(grids(covariance=FIT), H, method="GCI Celik")
    expanded = 1.25 * 0.02 * np.abs(SET.values)
    assert found.table["U_num"].to_numpy() == pytest.approx(expanded)
    assert found.combined.covariance == pytest.approx(FIT + np.diag((0.5 * expanded) ** 2))
    assert found.table["u_fit"].to_numpy() == pytest.approx(0.01 * np.abs(SET.values))
    assert found.table["u"].to_numpy() == pytest.approx(found.combined.bse.to_numpy())
    assert found.table["U95"].to_numpy() == pytest.approx(2.0 * found.table["u"].to_numpy())
    assert "GCI Celik" in found.combined.provenance.history[-1]
    assert "standard uncertainty" in found.combined.provenance.history[-1]


def test_set_without_a_fit_covariance_has_the_numerical_one_alone():
    found = derivative_uncertainty(grids(), H, method="GCI Celik")
    assert found.table["u_fit"].isna().all()
    assert found.combined.bse.to_numpy() == pytest.approx(0.5 * 1.25 * 0.02 * np.abs(SET.values))


def test_finest_grid_counts_whatever_the_order():
    sets = grids(covariance=FIT)
    found = derivative_uncertainty(sets[::-1], H[::-1])
    assert found.combined.values == pytest.approx(sets[0].values)
    assert found.combined.covariance == pytest.approx(derivative_uncertainty(sets, H).combined.covariance)


def test_terms_may_come_in_another_order():
    sets = grids(covariance=FIT)
    sets[1] = sets[1].subset(SET.names[::-1])
    straight = derivative_uncertainty(grids(covariance=FIT), H)
    assert derivative_uncertainty(sets, H).combined.covariance == pytest.approx(straight.combined.covariance)


def test_differences_within_the_scatter_are_said():
    wide = derivative_uncertainty(grids(covariance=100.0 * FIT), H)
    assert {one.rule for one in wide.findings} == {"grids-within-scatter"}
    assert len(wide.findings) == len(SET)
    assert derivative_uncertainty(grids(covariance=0.01 * FIT), H).findings == ()


def test_method_without_a_value_is_replaced_and_said():
    sets = [SET.with_values(Yv=value) for value in (-0.30, -0.31, -0.28)]
    found = derivative_uncertainty([*sets], H, method="GCI Roache")
    row = found.table.set_index("name").loc["Yv"]
    assert row["class"] == "oscillatory convergent"
    assert row["method"] == "data range"
    assert row["U_num"] == pytest.approx(0.015)
    rules = {(one.rule, one.place) for one in found.findings}
    assert ("numerical-method", "Yv") in rules


def test_other_terms_conventions_ship_are_refused():
    sets = grids()
    with pytest.raises(ConventionError, match="same terms: Nvdot"):
        derivative_uncertainty([sets[0], sets[1].subset([n for n in SET.names if n != "Nvdot"]), sets[2]], H)
    other = replace(sets[1], conventions=SET.conventions.but(force_scaling="L2"))
    with pytest.raises(ConventionError, match="force_scaling"):
        derivative_uncertainty([sets[0], other, sets[2]], H)
    with pytest.raises(ConventionError, match="ship with L"):
        derivative_uncertainty([sets[0], sets[1], replace(sets[2], ship=replace(SET.ship, L=4.0))], H)


def test_dimensional_sets_hold_at_one_speed():
    sets = [
        replace(
            one,
            conventions=SET.conventions.but(force_scaling="dimensional", sway_variable="v"),
            reference_speed=speed,
        )
        for one, speed in zip(grids(), (1.5, 1.5, 2.0), strict=True)
    ]
    with pytest.raises(ConventionError, match="holds at"):
        derivative_uncertainty(sets, H)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: derivative_uncertainty(grids()[:1], H[:1]), "1 derivative sets on 1 grids"),
        (lambda: derivative_uncertainty(grids(), H[:2]), "3 derivative sets on 2 grids"),
        (lambda: derivative_uncertainty(grids(), H, method="gci"), "no method 'gci'"),
    ],
)
def test_bad_input_is_named(call, words):
    with pytest.raises(TowtankError, match=words):
        call()
