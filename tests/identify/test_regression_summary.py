from __future__ import annotations

import numpy as np

from towtank.identify.regression import fit_linear
from towtank.identify.regression_summary import summary_text

RNG = np.random.default_rng(0)
V = RNG.uniform(-0.3, 0.3, 40)


def test_table_shows_values_intervals_and_covariance() -> None:
    design = np.column_stack([np.ones(40), V])
    fit = fit_linear(
        design,
        design @ [0.1, -0.315] + 0.01 * RNG.standard_normal(40),
        ["Y0", "Yv"],
        groups=np.repeat(np.arange(10), 4),
        covariance="cluster",
    )
    text = summary_text(fit)
    assert text == fit.summary()
    assert "cluster (10 groups, CR2)" in text
    row = next(line for line in text.splitlines() if line.startswith("Yv"))
    numbers = [float(part) for part in row.split()[1:]]
    np.testing.assert_allclose(numbers[0], fit["Yv"], rtol=1e-4)
    np.testing.assert_allclose(numbers[4:6], fit.conf_int()[1], rtol=1e-4)


def test_table_names_what_limits_the_fit() -> None:
    design = np.column_stack([V, V + 1e-5 * RNG.standard_normal(40)])
    response = -0.3 * V + 0.01 * RNG.standard_normal(40)
    response[11] += 1.0
    text = summary_text(fit_linear(design, response, ["Yv", "Yb"]))
    assert "Not separable by these data: Yv, Yb" in text
    assert "Outlying rows: 11" in text
    assert "R2 (uncentred)" in text
