import numpy as np
import pytest
from pydantic import BaseModel, ValidationError

from towtank.core.errors import ReadError
from towtank.formats.channels import Channel, ChannelMap, rotate_to_model
from towtank.formats.raw_table import RawTable


@pytest.fixture
def table():
    columns = {"t": [0.0, 0.5, 1.0], "Fx": [1.0, 2.0, 3.0], "Fy": [4.0, 5.0, 6.0], "yaw": [0.0, 90.0, 180.0]}
    units = {"t": "s", "Fx": "kN", "Fy": "", "yaw": "°"}
    return RawTable(
        {name: np.array(values) for name, values in columns.items()}, units, path="run.csv", sha256="ab"
    )


def mapped(**keys):
    return ChannelMap.model_validate(keys)


def test_shorthand_and_full_form():
    channels = mapped(time="t [s]", Y={"column": "Fy", "unit": "N", "sign": -1}, yaw_rate=3).channels
    assert channels["time"] == Channel(column="t", unit="s")
    assert channels["Y"] == Channel(column="Fy", unit="N", sign=-1)
    assert channels["r"] == Channel(column=3)


def test_units_of_the_file_and_of_the_map(table):
    record = mapped(time="t", X="Fx", Y="Fy [N]", psi="yaw").apply(table)
    np.testing.assert_array_equal(record["X"], [1000.0, 2000.0, 3000.0])
    np.testing.assert_array_equal(record["Y"], [4.0, 5.0, 6.0])
    np.testing.assert_allclose(record["psi"], [0.0, np.pi / 2, np.pi])
    assert record.units == {"time": "s", "X": "kN", "Y": "N", "psi": "°"}
    assert (record.source, record.sha256) == ("run.csv", "ab")


def test_sign_gain_and_offset(table):
    record = mapped(X={"column": "Fx", "unit": "kN", "sign": -1, "gain": 2.0, "offset": 0.5}).apply(table)
    np.testing.assert_allclose(record["X"], [-2500.0, -4500.0, -6500.0])


def test_steps_say_what_was_done(table):
    record = mapped(
        time="t",
        Y={"column": "Fy", "unit": "kN", "sign": -1},
        X={"column": "Fx", "unit": "N", "gain": 2.0, "offset": -0.5},
    ).apply(table)
    assert record.steps == (
        "time: column t [s] -> s",
        "Y: column Fy [kN] x -1 -> N",
        "X: column Fx [N], 2 x raw -0.5, -> N (the file prints [kN])",
    )


def test_si_needs_no_unit(table):
    record = mapped(Y={"column": "Fy", "unit": "SI"}, gauge={"column": "Fy", "unit": "SI"}).apply(table)
    np.testing.assert_array_equal(record["Y"], [4.0, 5.0, 6.0])
    np.testing.assert_array_equal(record["gauge"], [4.0, 5.0, 6.0])


def test_arrays_of_the_record_are_its_own(table):
    record = mapped(time="t").apply(table)
    record["time"][0] = 5.0
    assert table.columns["t"][0] == 0.0


def test_propeller_rate_in_revolutions_per_second(table):
    record = mapped(propeller_rate={"column": "Fy", "unit": "rpm"}, r={"column": "Fy", "unit": "rpm"}).apply(table)
    np.testing.assert_allclose(record["propeller_rate"], np.array([4.0, 5.0, 6.0]) / 60)
    np.testing.assert_allclose(record["r"], np.array([4.0, 5.0, 6.0]) * 2 * np.pi / 60)


@pytest.mark.parametrize(
    ("name", "unit", "fault"),
    [
        ("X", "kg", r"unit 'kg' is of dimension mass where force is expected -> give unit = 'N', 'kN' or 'kgf'"),
        ("u", "mm", r"unit 'mm' is of dimension length where velocity is expected -> give unit = 'm/s'"),
        ("psi", "-", r"unit '-' is of dimension dimensionless where angle is expected"),
        ("N", "N", r"unit 'N' is of dimension force where moment is expected"),
        ("r", "Hz", r"unit 'Hz' is of dimension frequency where angular velocity is expected"),
        (
            "udot",
            "g",
            r"unit 'g' is of dimension mass where acceleration is expected -> give unit = 'm/s2' or 'g_0'",
        ),
        ("psi", "grad", r"unit 'grad' has two readings"),
        ("X", "quux", r"unit 'quux' is unknown"),
    ],
)
def test_wrong_units_name_the_channel(table, name, unit, fault):
    with pytest.raises(ReadError, match=rf"^run.csv, channel {name}: {fault}"):
        mapped(**{name: {"column": "Fy", "unit": unit}}).apply(table)


def test_missing_unit(table):
    with pytest.raises(
        ReadError, match=r"channel Y: column 'Fy' has no unit in the file -> give unit = 'N', .*or unit = 'SI'"
    ):
        mapped(Y="Fy").apply(table)
    with pytest.raises(ReadError, match="has no unit in the file"):
        mapped(gauge="Fy").apply(table)


def test_unknown_column(table):
    with pytest.raises(
        ReadError, match=r"run.csv, channel Y: there is no column 'fy_' -> closest: Fy; the file has t"
    ):
        mapped(Y="fy_ [N]").apply(table)


def test_columns_by_number_mean_the_file_even_when_few_were_read(table):
    few = RawTable({"Fy": table.columns["Fy"]}, path="run.csv", file_columns=("t", "Fx", "Fy", "yaw"))
    np.testing.assert_array_equal(mapped(Y={"column": 3, "unit": "N"}).apply(few)["Y"], [4.0, 5.0, 6.0])
    with pytest.raises(ReadError, match="column 2, 'Fx', was not read"):
        mapped(X={"column": 2, "unit": "N"}).apply(few)


def test_column_stored_with_its_unit(table):
    stored = RawTable({"Fx [kN]": np.array([1.0])})
    assert mapped(X="Fx [kN]").apply(stored)["X"].tolist() == [1000.0]


def test_expected_columns():
    assert mapped(time="t", X="Fx [N]", Y=3, gauge="Fx").expected_columns() == ("t", "Fx", 3)


def test_crosstalk_in_si_and_with_the_signs(table):
    matrix = [[1.0, 0.1], [0.5, 2.0]]
    record = mapped(
        X="Fx", Y={"column": "Fy", "unit": "N", "sign": -1}, crosstalk=matrix, crosstalk_channels=["X", "Y"]
    ).apply(table)
    read = np.array([[1000.0, 2000.0, 3000.0], [-4.0, -5.0, -6.0]])
    np.testing.assert_allclose([record["X"], record["Y"]], np.array(matrix) @ read)
    assert record.steps[-1] == "X, Y: cross-talk matrix [[1.0, 0.1], [0.5, 2.0]] of the balance"


@pytest.mark.parametrize(
    ("keys", "fault"),
    [
        ({"crosstalk": [[1.0, 0.0]], "crosstalk_channels": ["X", "Y"]}, "must be square"),
        ({"crosstalk": [[1.0, 0.0], [0.0]], "crosstalk_channels": ["X", "Y"]}, "must be square"),
        ({"crosstalk": [[1.0, 1.0], [1.0, 1.0]], "crosstalk_channels": ["X", "Y"]}, "is singular"),
        ({"crosstalk": [[1.0]], "crosstalk_channels": ["K"]}, "must be different mapped channels"),
        ({"crosstalk": [[1.0, 0.0], [0.0, 1.0]], "crosstalk_channels": ["X", "X"]}, "must be different mapped"),
        ({"crosstalk": [[1.0]]}, "must be square"),
        ({"crosstalk_channels": ["X"]}, "without the matrix"),
        ({"Y": {"column": "Fy", "sign": 2}}, "Input should be 1 or -1"),
        ({"Y": {"column": "Fy", "gain": 0}}, "a gain of 0 deletes the channel"),
        ({"Y": {"column": "Fy", "gian": 2}}, "Extra inputs are not permitted"),
        ({"forces": "earth-fixed"}, "'model-fixed' or 'carriage-fixed'"),
        ({"r": "a", "yaw_rate": "b"}, "are the same channel"),
    ],
)
def test_faulty_maps(keys, fault):
    with pytest.raises(ValidationError, match=fault):
        mapped(**({"X": "Fx", "Y": "Fy"} | keys))


def test_empty_map_and_carriage_fixed_forces_without_both():
    with pytest.raises(ValidationError, match="no channel is mapped"):
        mapped()
    with pytest.raises(ValidationError, match="need both X and Y"):
        mapped(X="Fx", forces="carriage-fixed")


def test_error_names_the_key():
    class File(BaseModel):
        channels: ChannelMap

    with pytest.raises(ValidationError) as caught:
        File.model_validate({"channels": {"Y": {"column": "Fy", "sign": 2}}})
    assert caught.value.errors()[0]["loc"] == ("channels", "Y", "sign")


def test_carriage_fixed_forces_with_the_heading_channel(table):
    record = mapped(X="Fx [N]", Y="Fy [N]", psi="yaw", forces="carriage-fixed").apply(table)
    np.testing.assert_allclose(record["X"], [1.0, 5.0, -3.0], atol=1e-12)
    np.testing.assert_allclose(record["Y"], [4.0, -2.0, -6.0], atol=1e-12)
    assert record.steps[-1] == "X, Y: turned from carriage axes to ship axes by channel psi"


def test_carriage_fixed_forces_with_a_given_heading(table):
    channels = mapped(X="Fx [N]", Y="Fy [N]", forces="carriage-fixed")
    record = channels.apply(table, psi=np.pi / 2)
    np.testing.assert_allclose(record["X"], [4.0, 5.0, 6.0], atol=1e-12)
    assert record.steps[-1].endswith("by psi = 1.5708 rad")
    each = channels.apply(table, psi=np.full(3, np.pi / 2))
    np.testing.assert_array_equal(each["X"], record["X"])
    assert each.steps[-1].endswith("by the given heading")


def test_missing_or_unfitting_heading(table):
    channels = mapped(X="Fx [N]", Y="Fy [N]", forces="carriage-fixed")
    with pytest.raises(ReadError, match="carriage-fixed forces need the heading -> map a channel psi"):
        channels.apply(table)
    with pytest.raises(ReadError, match="the given heading has 2 values for 3 samples"):
        channels.apply(table, psi=np.zeros(2))


def test_only_some_channels(table):
    whole = mapped(time="t", X="Fx", Y="Fy [N]", forces="carriage-fixed")
    assert list(whole.only("time", "K").apply(table).channels) == ["time"]


def test_map_survives_json():
    whole = mapped(time="t [s]", X={"column": 2, "gain": 2.0}, forces="model-fixed")
    assert ChannelMap.model_validate_json(whole.model_dump_json()) == whole


def test_rotation_keeps_length_and_is_undone_by_the_opposite_heading():
    rng = np.random.default_rng(2)
    along, across, heading = rng.normal(size=(3, 50))
    X, Y = rotate_to_model(along, across, heading)
    np.testing.assert_allclose(np.hypot(X, Y), np.hypot(along, across))
    np.testing.assert_allclose(rotate_to_model(X, Y, -heading), [along, across], atol=1e-14)
    # A drag along the tank on a model with its bow to starboard presses on its port side: Y is positive.
    assert rotate_to_model(-1.0, 0.0, 0.1)[1] > 0
