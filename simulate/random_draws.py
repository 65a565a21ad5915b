"""Standard normal numbers for the draws of an ensemble: each draw has its own stretch of one random stream."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from ..core.errors import SimulationError

Sampling = Literal["random", "antithetic", "latin hypercube"]

_WORDS = 4
"""Words that one step of the counter of Philox yields."""


def standard_normals(draws: int, columns: int, seed: int = 0, sampling: Sampling = "random") -> np.ndarray:
    """Independent standard normal numbers, a row a draw.

    Parameters
    ----------
    draws, columns : int
        Numbers of rows and of parameters.
    seed : int
    sampling : {"random", "antithetic", "latin hypercube"}
        ``antithetic``: each second draw mirrors the one before it, which makes means of nearly linear indices sharp;
        ``latin hypercube``: each parameter has one draw in each of `draws` strata of equal probability.

    Returns
    -------
    ndarray, shape (draws, columns)

    Notes
    -----
    The stream is that of the counter-based generator Philox (Salmon et al. 2011), a number being the normal quantile
    of 53 random bits. Draw ``k`` begins at a place of the counter that depends on ``k`` and `columns` alone: more
    draws with the same seed begin with the same draws (but for the Latin hypercube, whose strata depend on their
    number).

    Raises
    ------
    SimulationError
        For an unknown sampling or a negative seed.
    """
    from scipy.special import ndtri

    if sampling not in get_args(Sampling):
        raise SimulationError(
            f"sampling '{sampling}' is not known", cure=f"use one of {', '.join(get_args(Sampling))}"
        )
    if seed < 0:
        raise SimulationError(f"the seed {seed} is negative", cure="give 0 or more")
    if sampling == "antithetic":
        half = standard_normals((draws + 1) // 2, columns, seed)
        mirrored = np.repeat(half, 2, axis=0)
        mirrored[1::2] *= -1.0
        return mirrored[:draws]
    shares = uniform_shares(draws, columns, seed)
    if sampling == "latin hypercube":
        order = np.random.Generator(np.random.Philox(np.random.SeedSequence(seed).spawn(1)[0]))
        strata = order.permuted(np.tile(np.arange(draws), (columns, 1)), axis=1).T
        shares = (strata + shares) / draws
    return ndtri(shares)


def uniform_shares(draws: int, columns: int, seed: int = 0, first: int = 0) -> np.ndarray:
    """Numbers evenly distributed between 0 and 1, both excluded, for the draws from number `first` on.

    Returns
    -------
    ndarray, shape (draws, columns)
    """
    steps = -(-columns // _WORDS)
    stream = np.random.Philox(seed)
    stream.advance(first * steps)
    words = stream.random_raw((draws, steps * _WORDS))[:, :columns]
    return ((words >> np.uint64(11)) + 0.5) * 2.0**-53
