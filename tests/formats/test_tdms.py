import sys

import numpy as np
import pytest
from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter

from towtank.core.errors import ReadError
from towtank.formats.tdms import read_tdms

T = np.linspace(0, 1, 5)


@pytest.fixture
def save(tmp_path):
    def write(channels, properties=None):
        path = tmp_path / "run.tdms"
        groups = dict.fromkeys(group for group, _, _, _ in channels)
        objects = [RootObject(properties={"facility": "tank 2"})]
        objects += [GroupObject(group, properties=properties or {}) for group in groups]
        objects += [ChannelObject(group, name, values, properties=own) for group, name, values, own in channels]
        with TdmsWriter(str(path)) as writer:
            writer.write_segment(objects)
        return path

    return write


def test_channels_units_and_properties(save):
    path = save(
        [("run", "t", T, {"unit_string": "s"}), ("run", "Fx", 2 * T, {"unit_string": "kN"})], {"speed": 1.5}
    )
    table = read_tdms(path)
    np.testing.assert_array_equal(table.columns["Fx"], 2 * T)
    assert table.units == {"t": "s", "Fx": "kN"}
    assert table.metadata == {"facility": "tank 2", "speed": 1.5}


def test_waveform_gives_the_time(save):
    wave = {"wf_increment": 0.02, "wf_start_offset": 0.1, "unit_string": "N"}
    table = read_tdms(save([("run", "Fx", T, wave), ("run", "Fy", T, wave)]))
    assert list(table.columns) == ["time", "Fx", "Fy"]
    np.testing.assert_allclose(table.columns["time"], 0.1 + 0.02 * np.arange(5))
    assert table.units["time"] == "s"


def test_channel_of_time_is_preferred_to_the_waveform(save):
    table = read_tdms(save([("run", "Time", T, {"wf_increment": 0.02})]))
    assert list(table.columns) == ["Time"]


def test_unequal_rates_are_refused(save):
    path = save([("run", "Fx", T, {"wf_increment": 0.02}), ("run", "Fy", T, {"wf_increment": 0.01})])
    with pytest.raises(ReadError, match=r"different rates or for different times \(Fx 50 Hz, Fy 100 Hz\)"):
        read_tdms(path)


def test_time_stamps_become_seconds(save):
    stamps = np.datetime64("2019-05-01T12:00:00", "us") + np.arange(5) * np.timedelta64(50, "ms")
    table = read_tdms(save([("run", "stamp", stamps, {}), ("run", "Fx", T, {})]))
    np.testing.assert_allclose(table.columns["stamp"], 0.05 * np.arange(5))
    assert table.units["stamp"] == "s"
    assert [finding.rule for finding in table.findings] == ["time-stamps"]


def test_groups(save):
    path = save([("a", "Fx", T, {}), ("b", "Fx", 2 * T, {})])
    with pytest.raises(ReadError, match=r"there are 2 groups with channels -> name one of a, b"):
        read_tdms(path)
    assert read_tdms(path, "b").columns["Fx"][-1] == 2.0
    with pytest.raises(ReadError, match=r"there is no group 'c' -> the groups are a, b"):
        read_tdms(path, "c")


def test_no_data(save):
    with pytest.raises(ReadError, match="there are no channels with data"):
        read_tdms(save([("a", "Fx", np.array([]), {})]))


def test_damaged_file(tmp_path):
    (tmp_path / "run.tdms").write_bytes(b"TDSm broken")
    with pytest.raises(ReadError, match=r"run.tdms: "):
        read_tdms(tmp_path / "run.tdms")


def test_missing_library_says_how_to_install_it(save, monkeypatch):
    path = save([("a", "Fx", T, {})])
    monkeypatch.setitem(sys.modules, "nptdms", None)
    with pytest.raises(ReadError, match=r"reading TDMS needs npTDMS -> install it: pip install 'towtank\[tdms\]'"):
        read_tdms(path)
