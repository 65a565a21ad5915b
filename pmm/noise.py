"""Measurement noise of virtual campaigns: white, autocorrelated, drift, zero error, resolution and shared gain.

Every size is relative to a reference force of the channel, because a balance is as noisy in a gentle run as in a
violent one. Each run draws from its own stream, seeded by the campaign's seed and the run's name, so that a run
keeps its noise when others are added, left out or made in another order.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from ..core.errors import CampaignError
from .reduced_run import FORCES


@dataclass(frozen=True)
class Noise:
    """Noise of the forces of a virtual campaign.

    Attributes
    ----------
    white : float
        Standard deviation of white noise, as a share of the channel's reference force.
    ar1 : float
        Standard deviation of first-order autoregressive noise, as a share of the reference force.
    rho : float
        Correlation of neighbouring samples of the autoregressive noise, 0 <= rho < 1.
    drift : float
        Standard deviation over the runs of the change of zero between begin and end of a record, as a share of
        the reference force; the zero moves in a straight line.
    offset : float
        Standard deviation over the runs of a zero error that stays constant in a record, as a share of the
        reference force.
    quantum : float
        Step of the analogue-digital conversion, as a share of the reference force; the last thing that
        happens to a reading.
    gain_bias : float
        Standard deviation of the gain error of a channel, relative. It is drawn once a campaign and shared by
        all runs, so that repeating runs does not average it away (type B).
    seed : int
        Seed of the campaign.
    """

    white: float = 0.0
    ar1: float = 0.0
    rho: float = 0.9
    drift: float = 0.0
    offset: float = 0.0
    quantum: float = 0.0
    gain_bias: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        for item in fields(self):
            value = getattr(self, item.name)
            if not (math.isfinite(value) and value >= 0):
                raise CampaignError(
                    f"{item.name} = {value} is not a size of noise",
                    cure="give a number that is zero or positive",
                    place=f"noise.{item.name}",
                )
        if self.rho >= 1:
            raise CampaignError(
                f"rho = {self.rho} never forgets", cure="give a correlation below 1", place="noise.rho"
            )

    @property
    def silent(self) -> bool:
        """True when the readings are the forces themselves."""
        return not (self.white or self.ar1 or self.drift or self.offset or self.quantum or self.gain_bias)

    def stream(self, name: str) -> np.random.Generator:
        """Random numbers that belong to `name` and to nothing else in a campaign of this seed."""
        words = np.frombuffer(hashlib.sha256(name.encode()).digest(), dtype=">u4")
        return np.random.default_rng(
            np.random.SeedSequence(self.seed, spawn_key=tuple(int(word) for word in words))
        )

    @cached_property
    def gains(self) -> dict[str, float]:
        """Gain of the channels X, Y, N and K in this campaign, 1 where there is no bias."""
        errors = self.stream("gain shared by all runs").standard_normal(len(FORCES))
        return {name: 1.0 + self.gain_bias * float(error) for name, error in zip(FORCES, errors)}

    def readings(
        self,
        forces: Mapping[str, np.ndarray],
        reference: Mapping[str, float],
        run: str,
        zero: Mapping[str, float] | None = None,
    ) -> dict[str, np.ndarray]:
        """What the balance writes down in one run.

        Parameters
        ----------
        forces : mapping of str to ndarray, shape (n,)
            True channels among X, Y, N and K, in N and Nm.
        reference : mapping of str to float
            Reference force of each channel in N or Nm, which the sizes are shares of.
        run : str
            Name of the run; it selects the random numbers.
        zero : mapping of str to float, optional
            Reading at rest in N or Nm, which all runs share; 0 when not named.

        Returns
        -------
        dict of str to ndarray, shape (n,)
        """
        levels = zero or {}
        if self.silent:
            return {name: values + levels.get(name, 0.0) for name, values in forces.items()}
        stream = self.stream(f"run {run}")
        n = len(next(iter(forces.values())))
        zero_error = stream.standard_normal((2, len(FORCES)))
        ramp = np.linspace(0.0, 1.0, n)
        result: dict[str, np.ndarray] = {}
        for name in (channel for channel in FORCES if channel in forces):
            row = FORCES.index(name)
            scatter = np.full(n, self.offset * zero_error[0, row])
            if self.drift:
                scatter += self.drift * zero_error[1, row] * ramp
            if self.white:
                scatter += self.white * stream.standard_normal(n)
            if self.ar1:
                scatter += self.ar1 * autoregressive(stream.standard_normal(n), self.rho)
            reading = self.gains[name] * forces[name] + reference[name] * scatter + levels.get(name, 0.0)
            result[name] = quantised(reading, self.quantum * reference[name])
        return result

    def density(self, frequencies: np.ndarray) -> np.ndarray:
        """Two-sided density of the random part, shape of `frequencies`, in squares of the reference force.

        Parameters
        ----------
        frequencies : ndarray
            In cycles a sample, 0 to 0.5.

        Notes
        -----
        Normalised so that the mean of n samples has variance S(0)/n and a cosine or sine coefficient fitted at f
        has variance 2 S(f)/n; white noise has S equal to its variance. Rounding to a step q adds q^2/12.
        """
        f = np.asarray(frequencies, dtype=float)
        coloured = (1.0 - self.rho**2) / (1.0 - 2.0 * self.rho * np.cos(2.0 * np.pi * f) + self.rho**2)
        return self.white**2 + self.quantum**2 / 12.0 + self.ar1**2 * coloured


SILENT = Noise()
"""No noise at all."""


def autoregressive(white: np.ndarray, rho: float) -> np.ndarray:
    """Stationary first-order autoregression of unit variance.

    Parameters
    ----------
    white : ndarray, shape (..., n)
        White noise of unit variance; time runs along the last axis.
    rho : float
        Correlation of neighbouring samples.

    Returns
    -------
    ndarray, shape (..., n)
        x_0 = e_0, x_t = rho x_(t-1) + sqrt(1 - rho^2) e_t.
    """
    from scipy.signal import lfilter

    innovation = math.sqrt(1.0 - rho * rho)
    driven = np.array(white, dtype=float)
    # The first sample is drawn from the stationary distribution, so that the series has no running-in.
    driven[..., 0] /= innovation
    return lfilter([innovation], [1.0, -rho], driven, axis=-1)


def quantised(values: np.ndarray, step: float) -> np.ndarray:
    """`values` rounded to whole multiples of `step`; unchanged for a step of 0."""
    return values if step <= 0 else step * np.round(values / step)


def reference_forces(runs: Iterable[Mapping[str, np.ndarray]]) -> dict[str, float]:
    """Largest magnitude of each channel in a campaign, which sizes of noise are shares of.

    Parameters
    ----------
    runs : iterable of mapping of str to ndarray
        True forces of every run, in N and Nm.

    Returns
    -------
    dict of str to float
        1 for a channel in which nothing happens.
    """
    largest: dict[str, float] = {}
    for forces in runs:
        for name, values in forces.items():
            size = float(np.abs(values).max(initial=0.0))
            largest[name] = max(largest.get(name, 0.0), size)
    return {name: size if size > 0 else 1.0 for name, size in largest.items()}
