"""MATLAB code for MSS: names of mariner.m, and that the code returns our force."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ConventionError
from towtank.core.terms import Term
from towtank.datasets import load_set
from towtank.report.mss_export import matlab_name, mss_text

# mariner.m of the MSS toolbox
MARINER = {
    "m": 798e-5, "Iz": 39.2e-5, "xG": -0.023, "Xudot": -42e-5, "Yvdot": -748e-5, "Nvdot": 4.646e-5, "Yrdot": -9.354e-5,
    "Nrdot": -43.8e-5, "Xu": -184e-5, "Xvv": -899e-5, "Xrv": 798e-5, "Yr": -499e-5, "Yvvr": 15356e-5, "Yd": 278e-5,
    "Nr": -166e-5, "Nd": -139e-5, "Nvvd": -489e-5, "Y0u": -8e-5, "N0uu": 3e-5,
}  # fmt: skip


def run(text: str, **state: Any) -> dict[str, Any]:
    """Values after the MATLAB code, which is close enough to Python."""
    source = re.sub(r"%[^\n]*", "", text).replace("...\n", " ").replace("^", "**").replace(";", "\n")
    source = re.sub(r"x\((\d)\)", lambda match: f"x[{int(match.group(1)) - 1}]", source)
    names = {"abs": np.abs, **state}
    for line in source.splitlines():
        exec(line.strip(), names)
    return names


def force(text: str, derivatives: DerivativeSet, surge: float, v: float, r: float, delta: float) -> dict[str, Any]:
    """State of mariner.m for a motion in SI, then its code."""
    ship, approach = derivatives.ship, derivatives.reference_speed or 1.0
    speed = np.hypot(surge, v)
    return run(
        text,
        x=[surge - approach, v, r],
        U0=approach,
        U=speed,
        u=(surge - approach) / speed,
        v=v / speed,
        r=r * ship.L / speed,
        delta=delta,
        m=0.0,
        Iz=0.0,
    )


def test_the_mariner_comes_out_as_in_mss() -> None:
    names = run(mss_text(load_set("mariner")), u=0.1, v=0.05, r=-0.2, delta=0.1, U=7.0)
    for name, value in MARINER.items():
        assert names[name] == pytest.approx(value, rel=1e-6), name
    assert names["m22"] == pytest.approx(798e-5 + 748e-5, rel=1e-6)
    # forces as mariner.m writes them, terms in v, r and delta of N by hand at u = 0
    n = run(mss_text(load_set("mariner")), u=0.0, v=0.05, r=-0.2, delta=0.1, U=7.0)["N"]
    by_hand = -264e-5 * 0.05 + 166e-5 * 0.2 + 1636e-5 * 0.05**3 + 5483e-5 * 0.05**2 * 0.2 - 139e-5 * 0.1
    by_hand += 45e-5 * 0.1**3 + 13e-5 * 0.05 * 0.1**2 - 489e-5 * 0.05**2 * 0.1 + 3e-5
    assert n == pytest.approx(by_hand, rel=1e-9)


@pytest.mark.parametrize(
    ("key", "tolerance"),
    # exact to the eight digits written; the drift angle of the inland ship becomes v' by a series
    [("kvlcc2", 1e-6), ("mariner", 1e-6), ("dtmb5512-efd", 1e-6), ("dtmb5415", 1e-6), ("inland-deep", 2e-3)],
)
def test_the_code_returns_the_force(key: str, tolerance: float) -> None:
    derivatives = load_set(key)
    ship, approach = derivatives.ship, derivatives.reference_speed or 1.0
    surge, v, r, delta = 0.95 * approach, -0.12 * approach, 0.3 * approach / ship.L, 0.2
    text = mss_text(derivatives)
    names = force(text, derivatives, surge, v, r, delta)
    motion = {"surge": surge, "v": v, "r": r, "udot": 0.0, "vdot": 0.0, "rdot": 0.0, "delta": -delta}
    ours = derivatives.to("midship").forces(motion, approach_speed=approach)
    unit = 0.5 * ship.rho * ship.L**2 * names["U"] ** 2
    mass, x_g = ship.displacement_mass or 0.0, ship.xG
    inertia = {"X": mass * (v * r + x_g * r**2), "Y": -mass * surge * r, "N": -mass * x_g * surge * r}
    if derivatives.conventions.rigid_body_inertia == "inside":
        inertia = dict.fromkeys("XYN", 0.0)
    if derivatives.conventions.added_mass_coriolis == "outside":
        lt = 0.5 * ship.rho * ship.L**2 * ship.T
        values = derivatives.to("lt")
        inertia["X"] += -lt * values["Yvdot"] * v * r if "Yvdot" in values else 0.0
        inertia["Y"] += lt * values["Xudot"] * surge * r if "Xudot" in values else 0.0
    # the resistance stays outside of X
    constant = names.get("X0", 0.0) - names.get("R0", 0.0)
    assert names["X"] * unit == pytest.approx(
        float(ours.get("X", 0.0)) + inertia["X"] - constant * unit, rel=tolerance
    )
    assert names["Y"] * unit == pytest.approx(float(ours["Y"]) + inertia["Y"], rel=tolerance)
    assert names["N"] * unit * ship.L == pytest.approx(float(ours["N"]) + inertia["N"], rel=tolerance)


def test_resistance_and_missing_masses_are_said(hull: DerivativeSet) -> None:
    text = mss_text(hull)
    assert "% X = X + R0*((U0/U)^2 - 1);" in text
    assert "% NOT IN THE SET, written as 0: Xudot" in text
    assert "Xudot = 0;    % NOT IN THE SET" in text
    assert "R0*v" not in text


@pytest.mark.parametrize(
    ("name", "variable"), [("Yv|v|", "Yvav"), ("Nr|v|", "Navr"), ("Xvr", "Xrv"), ("Yvdot", "Yvdot"), ("R0", "R0")]
)
def test_matlab_names(name: str, variable: str) -> None:
    assert matlab_name(Term.parse(name)) == variable


def test_terms_without_a_place_are_refused(hull: DerivativeSet) -> None:
    with pytest.raises(ConventionError, match="'Xvphi' has no place in the three-degree-of-freedom model of MSS"):
        mss_text(load_set("pcc-deep"))
    with pytest.raises(ConventionError, match="'Kvdot' has no place"):
        mss_text(load_set("s175-son-nomoto"))
    modulus = DerivativeSet.from_values("m", hull.ship, {"Yv|v|": -1.0}, HOME.but(origin=0.1))
    with pytest.raises(ConventionError, match="cannot be written in the conventions of MSS"):
        mss_text(modulus)
