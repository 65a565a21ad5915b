"""Mean squat and wave-frequency motion of a run in regular waves: mean and three harmonics, frequency free."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..identify.harmonics import HarmonicFit, fit_harmonics
from .head_waves import phase_at
from .sinkage_record import SinkageRecord

if TYPE_CHECKING:
    import pandas as pd

FEWEST_CYCLES = 10.0
"""Cycles that ITTC asks for in the analysis of a run in regular waves."""


@dataclass(frozen=True, eq=False)
class SquatInWaves:
    """Harmonics of one run.

    Attributes
    ----------
    run : str
    fits : mapping of str to HarmonicFit
        Of each quantity at the one frequency of encounter: ``sinkage_<place>`` in m, positive down; ``trim`` as a
        slope, positive by the bow; extra channels in SI.
    units : mapping of str to str
    omega, omega_se : float
        Frequency of encounter and its standard error in rad/s.
    start, stop : float
        Window in s.
    notes : tuple of str
        What is to be known about the window.
    """

    run: str
    fits: Mapping[str, HarmonicFit]
    units: Mapping[str, str]
    omega: float
    omega_se: float
    start: float
    stop: float
    notes: tuple[str, ...] = ()

    @property
    def frame(self) -> pd.DataFrame:
        """One row a quantity: mean, amplitude and phase (rad, lead) of each harmonic with standard errors, unit."""
        import pandas as pd

        rows = []
        for name, fit in self.fits.items():
            row: dict[str, float | str] = {
                "run": self.run,
                "quantity": name,
                "mean": float(fit.mean),
                "se": float(fit.se_mean),
            }
            for number in range(1, fit.order + 1):
                size, turn = harmonic_errors(fit, number)
                row[f"amplitude_{number}"], row[f"amplitude_{number}_se"] = float(fit.amplitude[number - 1]), size
                row[f"phase_{number}"], row[f"phase_{number}_se"] = float(fit.phase[number - 1]), turn
            rows.append({**row, "omega": self.omega, "r2": float(fit.r2), "unit": self.units[name]})
        return pd.DataFrame(rows)

    def response(self, quantity: str, wave: str, *, wave_x: float, to_x: float, k: float) -> complex:
        """Transfer function of a quantity: its first harmonic over that of the wave, moved along the ship.

        Parameters
        ----------
        quantity, wave : str
            The response and the wave elevation, both in `fits`.
        wave_x, to_x : float
            Place of the wave gauge and of the reference, in m forward of midship; the gauge moves with the ship.
        k : float
            Wave number in rad/m.

        Returns
        -------
        complex
            Amplitude ratio and phase lead over the wave at `to_x`, in head waves, in the signs of the channels.

        Raises
        ------
        FitError
            When one of the two was not analysed, or the gauge saw no wave.
        """
        for name in (quantity, wave):
            if name not in self.fits:
                raise FitError(
                    f"'{name}' was not analysed", cure=f"name one of {', '.join(self.fits)}", place=self.run
                )
        motion, elevation = self.fits[quantity], self.fits[wave]
        height = float(elevation.amplitude[0])
        if height <= 0.0:
            raise FitError("the gauge saw no wave", cure="name another wave channel", place=f"channel {wave}")
        moved = phase_at(float(elevation.phase[0]), wave_x, to_x, k)
        return complex(float(motion.amplitude[0]) / height * np.exp(1j * (float(motion.phase[0]) - moved)))


def harmonic_errors(fit: HarmonicFit, number: int = 1) -> tuple[float, float]:
    """Standard errors of the amplitude, in its unit, and of the phase, in rad, of one harmonic of one channel.

    Parameters
    ----------
    fit : HarmonicFit
    number : int
        1 for the first harmonic.

    Returns
    -------
    (float, float)
        The phase of a harmonic without amplitude is not known: infinite.
    """
    vector = np.array([fit.cos[number - 1], fit.sin[number - 1]], dtype=float)
    amplitude = float(np.hypot(*vector))
    # A harmonic that is not there has no direction: any one bounds its error.
    along = vector / amplitude if amplitude > 0.0 else np.array([1.0, 0.0])
    across = np.array([-along[1], along[0]])
    cov = fit.cov[2 * number - 1 : 2 * number + 1, 2 * number - 1 : 2 * number + 1]
    size, turn = (float(np.sqrt(max(float(of @ cov @ of), 0.0))) for of in (along, across))
    return size, turn / amplitude if amplitude > 0.0 else float("inf")


def reduce_in_waves(
    record: SinkageRecord,
    *,
    start: float,
    stop: float,
    omega: float | None = None,
    order: int = 3,
    places: Mapping[str, float] | None = None,
    run: str = "",
) -> SquatInWaves:
    """Mean and harmonics of a run in regular waves.

    Parameters
    ----------
    record : SinkageRecord
    start, stop : float
        Times in s between which the waves are regular: after the transients, before reflections arrive.
    omega : float, optional
        Frequency of encounter in rad/s; found from the sinkage at bow and stern together when not given (variable
        projection), because the wave maker's frequency is not the ship's.
    order : int
        Highest harmonic.
    places : mapping of str to float, optional
        Name and x in m; bow, stern, midship and centre of gravity when not given.
    run : str
        Name; that of the file when empty.

    Raises
    ------
    FitError
        When the window holds less than a cycle or nothing varies.
    """
    inside = (record.time >= start) & (record.time <= stop)
    if np.count_nonzero(inside) < 4 * (2 * order + 2):
        raise FitError(
            f"{np.count_nonzero(inside)} samples between {start:g} and {stop:g} s carry no {order} harmonics",
            cure="widen the window or check its times",
            file=record.name or None,
        )
    time = record.time[inside]
    where = dict(places) if places is not None else record.layout.places
    columns = {f"sinkage_{name}": record.sinkage_at(x)[inside] for name, x in where.items()}
    units = dict.fromkeys(columns, "m")
    columns["trim"], units["trim"] = record.trim[inside], "m/m"
    for name, values in record.extra.items():
        columns[name], units[name] = values[inside], record.extra_units.get(name, "")
    half = 0.5 * record.layout.length
    ends = np.column_stack([record.sinkage_at(half)[inside], record.sinkage_at(-half)[inside]])
    try:
        together = fit_harmonics(time, ends, omega=omega, order=order)
        fits = {
            name: fit_harmonics(time, values, omega=together.omega, order=order)
            for name, values in columns.items()
        }
    except FitError as error:
        raise FitError(error.cause, cure=error.cure, file=record.name or None, place=error.place) from error
    notes = []
    if together.n_cycles < FEWEST_CYCLES:
        notes.append(f"{together.n_cycles:.1f} cycles in the window; ITTC asks for {FEWEST_CYCLES:g}")
    return SquatInWaves(
        run or record.name, fits, units, together.omega, together.omega_se, start, stop, tuple(notes)
    )
