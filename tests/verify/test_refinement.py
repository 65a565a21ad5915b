"""Spacings, ratios and what is said of them."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.verify import refinement_findings, refinement_ratios, spacings_from_cells, spacings_from_ratio


def test_spacings_of_a_cube_and_of_a_plane():
    assert spacings_from_cells([8e6, 1e6]) == pytest.approx([1.0, 2.0])
    assert spacings_from_cells([4500, 18000], 2) == pytest.approx([2.0, 1.0])


def test_ratios_do_not_depend_on_the_order():
    assert refinement_ratios([4.0, 1.0, 1.5]) == pytest.approx([1.5, 4.0 / 1.5])
    assert refinement_ratios(spacings_from_ratio(4, 1.4)) == pytest.approx([1.4, 1.4, 1.4])


def test_true_ratios_of_dtmb_5512_are_not_the_assumed_ones():
    h = spacings_from_cells([1360061, 2533357, 6009588])
    found = refinement_findings(h, 1.4)
    assert [one.rule for one in found] == ["refinement-ratio", "small-refinement"]
    assert "1.23, not the assumed 1.4" in found[0].message
    assert refinement_ratios(h) == pytest.approx([1.334, 1.230], abs=5e-4)
    assert [one.message for one in refinement_findings(h, 1.4, tolerance=0.2) if one.severity == "warning"] == []


def test_good_ratios_raise_nothing():
    assert refinement_findings([1.0, 1.4, 1.96], 1.4) == ()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: spacings_from_cells([1e6, 0.0]), "0 cells"),
        (lambda: spacings_from_cells([1e6, np.nan]), "nan cells"),
        (lambda: spacings_from_cells([1e6, 8e6], 4), "4 dimensions"),
        (lambda: spacings_from_ratio(3, 0.7), "does not exceed 1"),
        (lambda: refinement_ratios([1.0, 1.0, 2.0]), "same spacing"),
        (lambda: refinement_ratios([1.0, -1.0]), "spacing -1"),
    ],
)
def test_bad_input_is_named(call, words):
    with pytest.raises(TowtankError, match=words):
        call()
