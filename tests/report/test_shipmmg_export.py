"""Parameters for shipmmg: names, conventions, and that its equations return our force."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ConventionError
from towtank.core.motion import force_units
from towtank.datasets import load_set
from towtank.report.shipmmg_export import shipmmg_text

# shipmmg.mmg_3dof.Mmg3DofManeuveringParams, less k_0, k_1, k_2 of the propeller
PARAMETERS = """
R_0_dash X_vv_dash X_vr_dash X_rr_dash X_vvvv_dash
Y_v_dash Y_r_dash Y_vvv_dash Y_vvr_dash Y_vrr_dash Y_rrr_dash
N_v_dash N_r_dash N_vvv_dash N_vvr_dash N_vrr_dash N_rrr_dash
"""


def run(text: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(text, names)
    return names


def shipmmg_force(p: dict[str, Any], v: float, r: float) -> tuple[float, float, float]:
    """Hull force of shipmmg's equations with the added-mass Coriolis terms that stand on their left side, at U = 1."""
    h = p["hull_derivatives"]
    x, y, n = (
        -h["R_0_dash"]
        + h["X_vv_dash"] * v**2
        + h["X_vr_dash"] * v * r
        + h["X_rr_dash"] * r**2
        + h["X_vvvv_dash"] * v**4,
        *(
            h[f"{f}_v_dash"] * v
            + h[f"{f}_r_dash"] * r
            + h[f"{f}_vvv_dash"] * v**3
            + h[f"{f}_vvr_dash"] * v**2 * r
            + h[f"{f}_vrr_dash"] * v * r**2
            + h[f"{f}_rrr_dash"] * r**3
            for f in "YN"
        ),
    )
    force = 0.5 * p["rho"] * p["L_pp"] * p["d"]
    rate, surge = r / p["L_pp"], np.sqrt(1 - v**2)
    return (
        force * x + p.get("m_y", 0.0) * v * rate,
        force * y - p.get("m_x", 0.0) * surge * rate,
        force * p["L_pp"] * n,
    )


def test_a_published_set_comes_out_as_printed() -> None:
    # Yasukawa and Yoshimura 2015, which is also the example of shipmmg
    names = run(shipmmg_text(load_set("kvlcc2")))
    hull = names["hull_derivatives"]
    assert list(hull) == PARAMETERS.split()
    assert (hull["R_0_dash"], hull["Y_v_dash"], hull["N_rrr_dash"]) == (0.022, -0.315, -0.013)
    assert names["m_y"] == pytest.approx(0.223 * 0.5 * 1000.0 * 7.0**2 * 0.455)
    assert names["J_z"] == pytest.approx(0.011 * 0.5 * 1000.0 * 7.0**4 * 0.455)


@pytest.mark.parametrize("with_surge_mass", [True, False])
def test_the_equations_of_shipmmg_return_the_force(hull: DerivativeSet, with_surge_mass: bool) -> None:
    derivatives = hull.with_values(Xudot=-0.012) if with_surge_mass else hull
    text = shipmmg_text(derivatives)
    names = run(text)
    assert (names["m_x"] > 0) == with_surge_mass
    assert ("ATTENTION: Xudot is not in the set" in text) == (not with_surge_mass)
    ship = hull.ship
    for v, r in ((-0.1, 0.0), (0.0, 0.3), (0.08, -0.2)):
        motion = {"surge": np.sqrt(1 - v**2), "v": v, "r": r / ship.L, "vdot": 0.0, "rdot": 0.0, "udot": 0.0}
        ours = derivatives.forces(motion, approach_speed=1.0)
        theirs = shipmmg_force(names, v, r)
        for component, value in zip("XYN", theirs, strict=True):
            # u' = sqrt(1 - v'^2) is a series that a cubic model cuts
            unit = force_units(component, ship, derivatives.conventions, 1.0)
            assert value == pytest.approx(float(ours[component]), abs=1e-5 * unit)


def test_what_is_missing_is_said_aloud() -> None:
    text = shipmmg_text(load_set("dtc-drift-efd"))
    assert "# NOT IN THE SET, written as 0: Xvr, Xrr, Yr," in text
    assert "Y_r_dash=0.0,  # NOT IN THE SET" in text
    assert "# m_y: Yvdot is not in the set" in text
    assert "Uncertainty: not given by the source" in text


def test_uncertainty_and_left_out_terms_are_in_the_text(hull: DerivativeSet) -> None:
    covariance = np.diag((0.01 * hull.values) ** 2)
    text = shipmmg_text(replace(hull, covariance=covariance))
    assert "N_v_dash=-0.16,  # std 0.0016" in text
    assert "# LEFT OUT: Yrdot = -0.01" in text
    assert "Converted: added_mass_coriolis inside -> outside" in text


@pytest.mark.parametrize(
    ("key", "term"), [("mariner", "Xu"), ("inland-deep", r"Yv\|v\|"), ("pcc-deep", "Xvphi"), ("esso-190k", "Xuu")]
)
def test_terms_without_a_place_are_refused(key: str, term: str) -> None:
    with pytest.raises(ConventionError, match=f"'{term}' has no place in the MMG model of shipmmg"):
        shipmmg_text(load_set(key))
