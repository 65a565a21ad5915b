import numpy as np

from towtank.decay.damping_models import damping_model
from towtank.decay.equivalent_damping import equivalent_linear
from towtank.decay.smooth_curve_fit import fit_smooth_curve

QUADRATIC = (0.04, 0.2, 0.0, 0.36, 0.0, 0.0)


def test_linear_decay(make_decay):
    result = fit_smooth_curve(make_decay((0.06, 0.0, 0.0, 0.36, 0.0, 0.0)), damping_model("linear"))
    np.testing.assert_allclose(result.values, [0.06, 0.36], rtol=1e-4)


def test_equivalent_damping_of_quadratic_damping(make_decay):
    result = fit_smooth_curve(make_decay(QUADRATIC))
    amplitude = np.array([0.1, 0.2, 0.3])
    np.testing.assert_allclose(
        result.equivalent(amplitude).alpha, equivalent_linear(np.array(QUADRATIC), amplitude)[0], rtol=0.02
    )


def test_interval_holds_the_truth_under_noise(make_decay):
    result = fit_smooth_curve(make_decay(QUADRATIC, noise=0.2, seed=4))
    amplitude = np.array([0.15, 0.25])
    at = result.equivalent(amplitude, level=0.99)
    true = equivalent_linear(np.array(QUADRATIC), amplitude)[0]
    assert ((at.alpha_lower < true) & (true < at.alpha_upper)).all()
