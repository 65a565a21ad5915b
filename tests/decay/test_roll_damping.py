import json

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.ship import Ship
from towtank.decay.damping_models import damping_model
from towtank.decay.fit_diagnostics import FitDiagnostics, FittedRun
from towtank.decay.integration_fit import fit_integration
from towtank.decay.roll_damping import CONVENTIONS, RollDamping, roll_damping

KVLCC2 = Ship("KVLCC2", 320.0, 58.0, 20.8, volume=312653.0, GM=5.73, rho=1000.0)
COVARIANCE = np.diag([1e-6, 1e-4, 1e-3, 1e-6])


@pytest.fixture
def damping() -> RollDamping:
    model = damping_model("linear+quadratic+cubic")
    values = {"b1": 0.04, "b2": 0.15, "b3": 0.3, "c1": 0.36}
    run = FittedRun(
        "a", np.arange(3.0), np.array([0.3, 0.2, 0.1]), np.array([0.3, 0.2, 0.1]), (0.3, 0.0), speed=1.0
    )
    diagnostics = FitDiagnostics(100, 12, 0.999, 0.001, 0.5, (0.1, 0.4))
    return roll_damping(
        "given", model, values, COVARIANCE, diagnostics=diagnostics, dof=30.0, runs=[run], scale=4.0
    )


def test_names_values_and_units(damping):
    assert damping.names == ("b1", "b2", "b3", "c1")
    assert damping["b2"] == 0.15
    assert damping.units == {"b1": "1/s", "b2": "1/rad", "b3": "s/rad2", "c1": "1/s2"}
    np.testing.assert_array_equal(damping.covariance, COVARIANCE)
    assert damping.conventions == CONVENTIONS
    assert list(damping.table().columns) == [
        "method",
        "model",
        "name",
        "value",
        "std",
        "lower95",
        "upper95",
        "unit",
    ]


def test_natural_frequency_and_ratio(damping):
    assert damping.omega_n == pytest.approx(0.6)
    assert damping.zeta == pytest.approx(0.04 / 1.2)
    assert damping.sd_of_omega_n == pytest.approx(1e-3 / 1.2)
    assert damping.sd_of_zeta == pytest.approx(np.hypot(1e-3 / 1.2, 0.5 * damping.zeta / 0.36 * 1e-3))


def test_band_follows_from_the_covariance(damping):
    draws = np.random.default_rng(1).multivariate_normal(damping.values, COVARIANCE, 40000)
    a = 0.25
    alpha = 0.5 * draws[:, 0] + 4.0 / (3.0 * np.pi) * np.sqrt(draws[:, 3]) * a * draws[:, 1]
    alpha += 0.375 * draws[:, 3] * a**2 * draws[:, 2]
    at = damping.equivalent(a)
    assert at.alpha_sd[0] == pytest.approx(alpha.std(), rel=0.02)
    assert at.alpha_upper[0] - at.alpha[0] == pytest.approx(2.0423 * at.alpha_sd[0], rel=1e-4)
    np.testing.assert_allclose(at.B, 2.0 * at.alpha)
    np.testing.assert_allclose(at.B_upper - at.B_lower, 2.0 * (at.alpha_upper - at.alpha_lower))
    assert at.zeta[0] == pytest.approx(at.alpha[0] / 0.6)


def test_extrapolation_is_marked(damping):
    assert damping.equivalent([0.05, 0.2, 0.5]).inside.tolist() == [False, True, False]


def test_extinction_in_degrees(damping):
    radians, degrees = damping.extinction(), damping.extinction(degrees=True)
    np.testing.assert_allclose(radians["value"], [0.10472, 0.2, 0.21206], rtol=1e-4)
    factor = np.radians(1.0)
    np.testing.assert_allclose(degrees["value"] / radians["value"], [1.0, factor, factor**2])
    assert degrees["unit"].tolist() == ["-", "1/deg", "1/deg2"]


def test_coefficients_in_degrees_differ_by_57(damping):
    table = damping.in_degrees()
    np.testing.assert_allclose(
        table["value"], [0.04, 0.15 * np.radians(1.0), 0.3 * np.radians(1.0) ** 2, 0.36], rtol=1e-12
    )
    assert table["unit"]["b2"] == "1/deg"


def test_bertin_is_the_loss_over_the_square(damping):
    table = damping.bertin([10.0])
    a, b, c = damping.extinction(degrees=True)["value"]
    assert table["N [1/deg]"][0] == pytest.approx((a * 10.0 + b * 100.0 + c * 1000.0) / 100.0, rel=1e-9)


def test_full_scale_by_froude(damping):
    full = damping.at_scale(1.0)
    np.testing.assert_allclose(full.values, [0.02, 0.15, 0.6, 0.09])
    np.testing.assert_allclose(full.runs[0].time, [0.0, 2.0, 4.0])
    assert full.runs[0].speed == 2.0
    np.testing.assert_allclose(full.equivalent(0.2).alpha, 0.5 * damping.equivalent(0.2).alpha)
    np.testing.assert_allclose(full.equivalent(0.2).zeta, damping.equivalent(0.2).zeta)
    np.testing.assert_allclose(full.at_scale(4.0).cov, damping.cov)


def test_dimensional_damping_and_its_form(damping):
    ship = KVLCC2.at_scale(4.0)
    frame = damping.dimensional(0.2, ship=ship)
    inertia = 1000.0 * ship.volume * 9.80665 * ship.GM / 0.36
    assert frame["B44 [N m s]"][0] == pytest.approx(2.0 * damping.equivalent(0.2).alpha[0] * inertia, rel=1e-3)
    full = damping.at_scale(1.0).dimensional(0.2, ship=KVLCC2)
    # The non-dimensional form does not change with scale.
    assert full["B44-hat [-]"][0] == pytest.approx(frame["B44-hat [-]"][0], rel=1e-9)
    with pytest.raises(FitError, match="at scale 1, the damping at 4"):
        damping.dimensional(0.2, ship=KVLCC2)
    with pytest.raises(FitError, match="needs the ship"):
        damping.dimensional(0.2)


def test_json(damping):
    data = json.loads(json.dumps(damping.to_dict()))
    assert data["values"] == pytest.approx([0.04, 0.15, 0.3, 0.36])
    assert data["conventions"] == CONVENTIONS


def test_result_of_a_fit_can_be_written_as_json(make_decay, literature):
    data = json.loads(json.dumps(fit_integration(make_decay(literature, noise=0.1)).to_dict()))
    assert data["diagnostics"]["converged"] is True
    assert data["provenance"]["choices"]["initial values"] == "free"


def test_bad_requests_are_named(damping):
    with pytest.raises(FitError, match="negative"):
        damping.equivalent([-0.1])
    with pytest.raises(FitError, match="confidence"):
        damping.equivalent(0.1, level=2.0)
    with pytest.raises(FitError, match="no coefficient 'b9'"):
        damping["b9"]
    with pytest.raises(FitError, match="not positive"):
        damping.at_scale(-1.0)
    with pytest.raises(FitError, match="does not restore"):
        roll_damping(
            "x",
            damping.model,
            {"b1": 1.0, "b2": 0.0, "b3": 0.0, "c1": -1.0},
            COVARIANCE,
            diagnostics=damping.diagnostics,
        )
