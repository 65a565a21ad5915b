"""Channels in SI."""

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.formats.raw_table import RawTable
from towtank.squat.si_channel import require_channels, si_channel

TABLE = RawTable({"h": np.array([1.0, 2.0]), "x": np.array([3.0, 4.0])}, {"h": "mm"}, path="run.dat")


def test_units_become_si_and_none_stays_as_it_is():
    np.testing.assert_allclose(si_channel(TABLE, "h", ("length",)), [1e-3, 2e-3])
    np.testing.assert_allclose(si_channel(TABLE, "x", ("length",)), [3.0, 4.0])
    np.testing.assert_allclose(si_channel(TABLE, "h"), [1e-3, 2e-3])


def test_another_quantity_is_refused():
    with pytest.raises(ReadError, match=r"channel h: is in mm, a length, and should be a velocity"):
        si_channel(TABLE, "h", ("velocity",))


def test_a_missing_channel_is_named_with_those_that_are_there():
    require_channels(TABLE, ("h", "x"))
    with pytest.raises(ReadError, match=r"run.dat: there is no channel 'y' -> the file has h, x"):
        require_channels(TABLE, ("h", "y"))
