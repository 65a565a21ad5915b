"""The channel map of a campaign: which column is which channel, in what unit and with what sign.

It is written once in the campaign file for all runs::

    [channels]
    time = "Time [s]"
    X = { column = "Fx", unit = "kN", sign = -1 }
    Y = "Fy [kN]"
    N = "Mz [kN m]"
    psi = "yaw angle [deg]"
    forces = "carriage-fixed"
    crosstalk = [[1.0, 0.01, 0.0], [0.02, 1.0, 0.0], [0.0, 0.0, 1.0]]
    crosstalk_channels = ["X", "Y", "N"]
"""

from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from ..core.errors import ReadError
from ..core.record import Record
from .raw_table import RawTable, find_column
from .units import SI_SYMBOLS, conversion, convertible, split_name

#: Dimension of each standard channel.
DIMENSIONS = {
    "time": "time",
    **dict.fromkeys(("X", "Y", "Z", "thrust"), "force"),
    **dict.fromkeys(("K", "M", "N", "torque"), "moment"),
    **dict.fromkeys(("x", "y", "heave", "sinkage_fore", "sinkage_aft"), "length"),
    **dict.fromkeys(("phi", "theta", "psi", "rudder_angle", "drift_angle"), "angle"),
    **dict.fromkeys(("u", "v", "w"), "velocity"),
    **dict.fromkeys(("p", "q", "r"), "angular velocity"),
    **dict.fromkeys(("udot", "vdot", "wdot"), "acceleration"),
    **dict.fromkeys(("pdot", "qdot", "rdot"), "angular acceleration"),
    "propeller_rate": "revolution rate",
}

#: Other names of standard channels.
ALIASES = {"yaw_rate": "r", "roll_rate": "p", "pitch_rate": "q"}

_LIKELY_UNITS = {
    "time": "'s' or 'ms'",
    "force": "'N', 'kN' or 'kgf'",
    "moment": "'N m', 'kN m' or 'kgf m'",
    "length": "'m' or 'mm'",
    "angle": "'rad' or 'deg'",
    "velocity": "'m/s', 'mm/s' or 'kn'",
    "angular velocity": "'rad/s' or 'deg/s'",
    "acceleration": "'m/s2' or 'g_0'",
    "angular acceleration": "'rad/s2' or 'deg/s2'",
    "revolution rate": "'1/s', 'rps' or 'rpm'",
}


class Channel(BaseModel):
    """One channel: value in SI = sign * (gain * raw + offset) converted from `unit`.

    A text such as ``"Fx [kN]"`` or ``"Fx"`` stands for the column and its unit.

    Attributes
    ----------
    column : str or int
        Name of the column as printed, or its number counted from 1 at the left.
    unit : str or None
        Unit of ``gain * raw + offset``; None takes the unit that the file prints; ``"SI"`` leaves the values as
        they are.
    sign : {1, -1}
        -1 turns the channel round.
    gain : float
        Factor on the raw values, for example newtons per volt.
    offset : float
        Added after the gain, in `unit`.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    column: str | int
    unit: str | None = None
    sign: Literal[1, -1] = 1
    gain: float = Field(default=1.0, allow_inf_nan=False)
    offset: float = Field(default=0.0, allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        if isinstance(value, int) and not isinstance(value, bool):
            return {"column": value}
        if isinstance(value, str):
            column, unit = split_name(value)
            return {"column": column, "unit": unit or None}
        return value

    @field_validator("gain")
    @classmethod
    def _not_zero(cls, gain: float) -> float:
        if gain == 0.0:
            raise ValueError("a gain of 0 deletes the channel; leave the channel out instead")
        return gain


class ChannelMap(BaseModel):
    """Channels by their standard name, and what is done to the forces.

    Any key other than the three below is a channel: a name of `DIMENSIONS`, whose unit is checked, one of
    `ALIASES`, or a name of the user's own.

    Attributes
    ----------
    crosstalk : list of list of float, shape (k, k), or None
        Calibration matrix C of the balance: true forces = C @ read forces, in SI and with the signs of the
        channels.
    crosstalk_channels : list of str
        The k channels that it applies to, in its order.
    forces : {"model-fixed", "carriage-fixed"}
        Axes in which X and Y were measured. Carriage-fixed ones are turned into the axes of the ship.
    """

    model_config = ConfigDict(extra="allow", frozen=True)
    __pydantic_extra__: dict[str, Channel] = Field(init=False)

    crosstalk: list[list[float]] | None = None
    crosstalk_channels: list[str] = Field(default_factory=list)
    forces: Literal["model-fixed", "carriage-fixed"] = "model-fixed"

    @model_validator(mode="after")
    def _consistent(self) -> "ChannelMap":
        given = list(self.__pydantic_extra__ or {})
        for alias, name in ALIASES.items():
            if alias in given and name in given:
                raise ValueError(f"'{alias}' and '{name}' are the same channel; keep one of them")
        if not given:
            raise ValueError('no channel is mapped; write e.g. time = "Time [s]"')
        names = set(self.channels)
        if self.forces == "carriage-fixed" and not {"X", "Y"} <= names:
            raise ValueError("carriage-fixed forces need both X and Y to be turned into the axes of the ship")
        self._check_crosstalk(names)
        return self

    def _check_crosstalk(self, names: set[str]) -> None:
        size = len(self.crosstalk_channels)
        if self.crosstalk is None:
            if size:
                raise ValueError("crosstalk_channels are given without the matrix crosstalk")
            return
        rows = [len(row) for row in self.crosstalk]
        if not size or len(rows) != size or set(rows) != {size}:
            raise ValueError(
                f"the matrix crosstalk has rows of {rows} values; it must be square with one row and column "
                f"for each of the {size} crosstalk_channels"
            )
        strangers = [name for name in self.crosstalk_channels if name not in names]
        if strangers or len(set(self.crosstalk_channels)) < size:
            raise ValueError(f"crosstalk_channels must be different mapped channels; not so: {strangers}")
        if not np.isfinite(self.crosstalk).all() or np.linalg.matrix_rank(self.crosstalk) < size:
            raise ValueError("the matrix crosstalk is singular")

    @property
    def channels(self) -> dict[str, Channel]:
        """Channels by standard name, aliases resolved."""
        return {ALIASES.get(name, name): channel for name, channel in (self.__pydantic_extra__ or {}).items()}

    def only(self, *names: str) -> "ChannelMap":
        """Map of these channels alone, without cross-talk and turn of the forces.

        It serves to look at one channel, such as the time, before the rest can be computed. Names that are not
        mapped are passed over.
        """
        kept = {name: channel for name, channel in self.channels.items() if name in names}
        return ChannelMap.model_validate(kept)

    def expected_columns(self) -> tuple[str | int, ...]:
        """Columns that a file must have, for ``read_table(columns=...)``; each named once."""
        return tuple(dict.fromkeys(channel.column for channel in self.channels.values()))

    def apply(self, table: RawTable, *, psi: ArrayLike | None = None) -> Record:
        """Channels of `table` in SI.

        The order is: gain, offset, unit, sign of each channel; cross-talk matrix; turn of carriage-fixed forces.

        Parameters
        ----------
        table : RawTable
            As read.
        psi : float or array_like, shape (n,), optional
            Heading in radians for carriage-fixed forces; default the channel ``psi``.

        Returns
        -------
        Record
            Channels in SI, their original units, and the steps that were taken. The arrays are its own.

        Raises
        ------
        ReadError
            If a column is missing, a unit is missing, unknown or of the wrong dimension, or the heading
            is missing.
        """
        values: dict[str, np.ndarray] = {}
        units: dict[str, str] = {}
        steps: list[str] = []
        for name, channel in self.channels.items():
            column = _column(name, channel, table)
            scale = _scale(name, channel, table.units.get(column, ""), table.path)
            converted = table.columns[column] * (channel.sign * channel.gain * scale.factor)
            if channel.offset:
                converted += channel.sign * channel.offset * scale.factor
            values[name], units[name] = converted, scale.unit
            steps.append(_step(name, column, channel, scale))
        if self.crosstalk is not None:
            read = np.stack([values[name] for name in self.crosstalk_channels])
            values.update(zip(self.crosstalk_channels, np.asarray(self.crosstalk) @ read))
            steps.append(
                f"{', '.join(self.crosstalk_channels)}: cross-talk matrix {self.crosstalk} of the balance"
            )
        if self.forces == "carriage-fixed":
            heading = self._heading(values, psi, table.path)
            values["X"], values["Y"] = rotate_to_model(values["X"], values["Y"], heading)
            said = "channel psi" if psi is None else "the given heading"
            if psi is not None and np.ndim(psi) == 0:
                said = f"psi = {float(np.asarray(psi)):.6g} rad"
            steps.append(f"X, Y: turned from carriage axes to ship axes by {said}")
        return Record(values, units, table.path, table.sha256, tuple(steps))

    @staticmethod
    def _heading(values: dict[str, np.ndarray], psi: ArrayLike | None, file: str) -> np.ndarray:
        if psi is None:
            if "psi" in values:
                return values["psi"]
            raise ReadError(
                "carriage-fixed forces need the heading",
                cure="map a channel psi, or give the drift angle of the run",
                file=file,
            )
        heading = np.asarray(psi, dtype=np.float64)
        if heading.ndim and heading.shape != values["X"].shape:
            raise ReadError(
                f"the given heading has {heading.size} values for {len(values['X'])} samples",
                cure="give one value, or one for each sample",
                file=file,
            )
        return heading


def rotate_to_model(X: ArrayLike, Y: ArrayLike, psi: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Forces in carriage-fixed axes turned into the axes of the ship.

    ``X = Fx cos psi + Fy sin psi`` and ``Y = -Fx sin psi + Fy cos psi``, both frames x forward, y to starboard.

    Parameters
    ----------
    X, Y : array_like, shape (n,)
        Forces along and across the tank.
    psi : array_like, shape (n,) or scalar
        Heading in radians, positive with the bow to starboard.

    Returns
    -------
    X, Y : ndarray, shape (n,)
        Forces along and across the ship.
    """
    along, across = np.asarray(X, dtype=np.float64), np.asarray(Y, dtype=np.float64)
    cosine, sine = np.cos(psi), np.sin(psi)
    return along * cosine + across * sine, across * cosine - along * sine


class _Scale(NamedTuple):
    unit: str
    factor: float
    symbol: str
    printed: str


def _column(name: str, channel: Channel, table: RawTable) -> str:
    place = f"channel {name}"
    by_number = isinstance(channel.column, int)
    names = table.file_columns if by_number else tuple(table.columns)
    column = find_column(channel.column, names, file=table.path, place=place, unit=channel.unit)
    if column not in table.columns:
        raise ReadError(
            f"column {channel.column}, '{column}', was not read",
            cure="read the expected columns of this channel map, or map a column of numbers",
            file=table.path,
            place=place,
        )
    return column


def _scale(name: str, channel: Channel, printed: str, file: str) -> _Scale:
    """Unit of a channel and its factor to SI, checked against the dimension of the channel."""
    dimension = DIMENSIONS.get(name)
    if channel.unit is not None and channel.unit.strip() == "SI":
        return _Scale("SI", 1.0, SI_SYMBOLS[dimension] if dimension else "SI", printed)
    unit = channel.unit if channel.unit is not None else printed
    place = f"channel {name}"
    likely = _LIKELY_UNITS.get(dimension or "", "'N', 'm/s' or '-'")
    if not unit.strip():
        raise ReadError(
            f"column '{channel.column}' has no unit in the file",
            cure=f"give unit = {likely}, or unit = 'SI'",
            file=file,
            place=place,
        )
    try:
        own = conversion(unit)
        factor = own.factor if dimension is None else convertible(unit, dimension)
    except ReadError as error:
        raise ReadError(error.cause, cure=error.cure, file=file, place=place) from None
    if factor is None:
        raise ReadError(
            f"unit '{unit}' is of dimension {own.dimension} where {dimension} is expected",
            cure=f"give unit = {likely} (and a gain if the column is not calibrated), or map another column",
            file=file,
            place=place,
        )
    dimension = dimension or own.dimension
    return _Scale(unit, factor, SI_SYMBOLS.get(dimension, dimension), printed)


def _step(name: str, column: str, channel: Channel, scale: _Scale) -> str:
    text = f"{name}: column {column} [{scale.unit}]"
    if channel.gain != 1.0 or channel.offset:
        text += f", {channel.gain:g} x raw {channel.offset:+g},"
    if channel.sign == -1:
        text += " x -1"
    text += f" -> {scale.symbol}"
    if scale.printed and scale.printed != scale.unit:
        text += f" (the file prints [{scale.printed}])"
    return text
