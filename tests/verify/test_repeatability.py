"""Student-t repeatability and coverage."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.verify.repeatability import coverage, pooled_repeats


def test_five_repeats_with_the_tabulated_factor():
    repeats = pooled_repeats([1.0, 2.0, 3.0, 4.0, 5.0])
    assert (repeats.mean, repeats.n) == (3.0, 5)
    assert repeats.sd == pytest.approx(math.sqrt(2.5))
    assert repeats.half_width == pytest.approx(2.7764 * math.sqrt(0.5), rel=1e-4)
    assert repeats.single_half_width == pytest.approx(2.7764 * math.sqrt(2.5 * 1.2), rel=1e-4)
    assert repeats.interval == pytest.approx((3.0 - repeats.half_width, 3.0 + repeats.half_width))


def test_intervals_of_few_repeats_cover_as_they_say():
    rng = np.random.default_rng(11)
    runs = [pooled_repeats(rng.normal(0.73, 0.02, 4)) for _ in range(2000)]
    lower, upper = zip(*(run.interval for run in runs), strict=True)
    assert coverage(lower, upper, 0.73) == pytest.approx(0.95, abs=0.015)


@pytest.mark.parametrize(
    ("values", "message"), [([1.0], r"1 run\(s\) have no repeatability"), ([1.0, np.nan], "run 2 has no value")]
)
def test_what_has_no_repeatability_is_named(values, message):
    with pytest.raises(TowtankError, match=message):
        pooled_repeats(values)


def test_coverage_counts_complete_rows():
    assert coverage([0.0, 0.0, np.nan], [1.0, 1.0, 1.0], [0.5, 2.0, 0.5]) == 0.5
    assert math.isnan(coverage([np.nan], [1.0], [0.0]))
    with pytest.raises(TowtankError, match="lower limit exceeds"):
        coverage([2.0], [1.0], [1.5])
    with pytest.raises(TowtankError, match="no probability"):
        pooled_repeats([1.0, 2.0], level=95)
