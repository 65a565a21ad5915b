"""A set of hydrodynamic derivatives with its uncertainty, terms, conventions, validity and history."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .conventions import Conventions, preset
from .conversion import conversion_map
from .errors import ConventionError, TermError
from .motion import Motion, force_units, origin_position, scaled_state
from .provenance import Provenance
from .ship import Ship
from .terms import Term, parse_terms

if TYPE_CHECKING:
    import pandas as pd


_CANCELLED = 1e-11
"""A converted term is rounding, not a term, when it is this much smaller than what went into it."""


@dataclass(frozen=True, eq=False)
class DerivativeSet:
    """Hull derivatives: values, covariance, terms, conventions.

    Attributes
    ----------
    name : str
    ship : Ship
    terms : tuple of Term
    values : ndarray, shape (n,)
        One value a term, in the units that `conventions` name.
    covariance : ndarray, shape (n, n), or None
        None when the source gives no uncertainty.
    conventions : Conventions
    reference_speed : float, optional
        Speed in m/s at which the set was found; dimensional and bis values hold at this speed.
    validity : mapping of str to (float, float)
        Range of each variable that the data covered, non-dimensional, e.g. ``{"v": (-0.3, 0.3)}``.
    diagnostics : mapping
        Fit diagnostics by name (n, dof, R2, VIF, condition number, ...); empty for published tables.
    dof : float
        Degrees of freedom behind the covariance; infinite when unknown.
    provenance : Provenance
    """

    name: str
    ship: Ship
    terms: tuple[Term, ...]
    values: np.ndarray
    conventions: Conventions
    covariance: np.ndarray | None = None
    reference_speed: float | None = None
    validity: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    diagnostics: Mapping[str, Any] = field(default_factory=dict)
    dof: float = float("inf")
    provenance: Provenance = field(default_factory=Provenance)

    def __post_init__(self) -> None:
        values = np.array(self.values, dtype=float)
        values.setflags(write=False)
        object.__setattr__(self, "terms", parse_terms(self.terms))
        object.__setattr__(self, "values", values)
        if values.shape != (len(self.terms),):
            raise TermError(f"set '{self.name}' has {len(self.terms)} terms but values of shape {values.shape}")
        if self.covariance is not None:
            covariance = np.array(self.covariance, dtype=float)
            covariance.setflags(write=False)
            if covariance.shape != (len(values), len(values)):
                raise TermError(
                    f"set '{self.name}': covariance of shape {covariance.shape} for {len(values)} terms"
                )
            object.__setattr__(self, "covariance", covariance)

    @classmethod
    def from_values(
        cls, name: str, ship: Ship, values: Mapping[str, float], conventions: Conventions, **more: Any
    ) -> DerivativeSet:
        """Set from a mapping of term name to value."""
        return cls(name, ship, parse_terms(values), np.array(list(values.values()), float), conventions, **more)

    # -- reading ---------------------------------------------------------------------------------------------

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the terms, in order."""
        return tuple(term.name for term in self.terms)

    def __contains__(self, name: str) -> bool:
        return name in self.names

    def __getitem__(self, name: str) -> float:
        return float(self.values[self._index(name)])

    def __len__(self) -> int:
        return len(self.terms)

    def _index(self, name: str) -> int:
        try:
            return self.names.index(name)
        except ValueError:
            raise TermError(f"set '{self.name}' has no '{name}'", cure=f"it has {', '.join(self.names)}") from None

    @property
    def params(self) -> pd.Series:
        """Values by name, as a pandas Series."""
        import pandas as pd

        return pd.Series(self.values, index=list(self.names), name=self.name)

    @property
    def bse(self) -> pd.Series:
        """Standard uncertainties by name; NaN when unknown."""
        import pandas as pd

        return pd.Series(self._standard_errors(), index=list(self.names), name="std")

    def cov_params(self) -> pd.DataFrame:
        """Covariance matrix as a DataFrame; NaN when unknown."""
        import pandas as pd

        matrix = np.full((len(self),) * 2, np.nan) if self.covariance is None else self.covariance
        return pd.DataFrame(matrix, index=list(self.names), columns=list(self.names))

    def conf_int(self, level: float = 0.95) -> pd.DataFrame:
        """Two-sided confidence interval of each value (Student t with :attr:`dof`)."""
        import pandas as pd
        from scipy.special import ndtri, stdtrit

        tail = 0.5 + level / 2
        quantile = stdtrit(self.dof, tail) if np.isfinite(self.dof) else ndtri(tail)
        half = quantile * self._standard_errors()
        return pd.DataFrame({"lower": self.values - half, "upper": self.values + half}, index=list(self.names))

    def _standard_errors(self) -> np.ndarray:
        if self.covariance is None:
            return np.full(len(self), np.nan)
        return np.sqrt(np.clip(np.diag(self.covariance), 0.0, None))

    def to_frame(self) -> pd.DataFrame:
        """Table with columns name, value, std, lower95, upper95, scaling."""
        import pandas as pd

        interval = self.conf_int()
        return pd.DataFrame(
            {
                "name": list(self.names),
                "value": self.values,
                "std": self._standard_errors(),
                "lower95": interval["lower"].to_numpy(),
                "upper95": interval["upper"].to_numpy(),
                "scaling": self.conventions.force_scaling,
            }
        )

    def summary(self) -> str:
        """Text table that can be pasted into a paper."""
        from .derivative_table import derivative_table

        return derivative_table(self)

    # -- changing --------------------------------------------------------------------------------------------

    def to(self, conventions: Conventions | str, **changes: Any) -> DerivativeSet:
        """The same hull in other conventions.

        Parameters
        ----------
        conventions : Conventions or str
            Target, or the name of a preset such as ``"mmg"``, ``"prime"``, ``"bis"``, ``"cog,drift-angle"``.
        **changes
            Single choices, applied last.

        Raises
        ------
        ConventionError
            When the conversion is not exact, or data for it is missing.
        """
        target = preset(conventions, self.conventions) if isinstance(conventions, str) else conventions
        target = target.but(**changes)
        if target == self.conventions:
            return self
        if target.scale != self.conventions.scale:
            raise ConventionError(
                "model and full scale differ by more than a name", cure="use at_scale(1) for the ship"
            )
        step = conversion_map(self.terms, self.conventions, target, self.ship, self.reference_speed)
        values = step.matrix @ self.values + step.offset
        covariance = None
        if self.covariance is not None:
            covariance = step.matrix @ self.covariance @ step.matrix.T
        keep = self._not_rounding(step.matrix, step.offset, values)
        differences = self.conventions.differences(target)
        note = "converted: " + ", ".join(f"{key} {a} -> {b}" for key, (a, b) in differences.items())
        return replace(
            self,
            terms=tuple(term for term, kept in zip(step.target, keep, strict=True) if kept),
            values=values[keep],
            covariance=None if covariance is None else covariance[np.ix_(keep, keep)],
            conventions=target,
            provenance=self.provenance.and_then(note),
        )

    def _not_rounding(self, matrix: np.ndarray, offset: np.ndarray, values: np.ndarray) -> np.ndarray:
        """False for terms that a conversion back has cancelled, so that round trips return the same terms."""
        size = np.abs(matrix) @ np.abs(self.values) + np.abs(offset)
        cancelled = (np.abs(values) <= _CANCELLED * size) & (size > 0)
        if self.covariance is None:
            return ~cancelled
        # A variance that should vanish keeps rounding of 1e-16, its root therefore 1e-8 of what went in.
        variance = np.einsum("ij,jk,ik->i", matrix, self.covariance, matrix)
        sd = np.sqrt(np.clip(variance, 0.0, None))
        return ~(cancelled & (sd <= 1e-6 * (np.abs(matrix) @ self._standard_errors())))

    def at_scale(self, scale: float, *, rho: float | None = None) -> DerivativeSet:
        """The set for the geometrically similar ship at another scale (Froude similarity).

        Non-dimensional values stay; dimensional values, the ship and the reference speed are scaled.
        """
        ship = self.ship.at_scale(scale, rho=rho)
        speed = None if self.reference_speed is None else self.reference_speed * (ship.L / self.ship.L) ** 0.5
        conventions = self.conventions.but(scale="full" if scale == 1 else "model")
        note = f"scaled from 1:{self.ship.scale:g} to 1:{scale:g}"
        if self.conventions.force_scaling != "dimensional":
            return replace(
                self,
                ship=ship,
                reference_speed=speed,
                conventions=conventions,
                provenance=self.provenance.and_then(note),
            )
        return self.to("lt").at_scale(scale, rho=rho).to("dimensional")

    def subset(self, names: Iterable[str]) -> DerivativeSet:
        """The named terms alone."""
        rows = [self._index(name) for name in names]
        return replace(
            self,
            terms=tuple(self.terms[i] for i in rows),
            values=self.values[rows],
            covariance=None if self.covariance is None else self.covariance[np.ix_(rows, rows)],
        )

    def with_values(self, **values: float) -> DerivativeSet:
        """Copy with some values replaced or terms added; new terms get no uncertainty."""
        table = dict(zip(self.names, self.values, strict=True)) | values
        terms = {term.name: term for term in self.terms}
        covariance = None
        if self.covariance is not None:
            covariance = np.zeros((len(table), len(table)))
            covariance[: len(self), : len(self)] = self.covariance
        return replace(
            self,
            terms=tuple(terms.get(name) or Term.parse(name) for name in table),
            values=np.array(list(table.values()), float),
            covariance=covariance,
        )

    # -- using -----------------------------------------------------------------------------------------------

    def forces(self, motion: Motion, *, approach_speed: float | np.ndarray | None = None) -> dict[str, np.ndarray]:
        """Hull forces in newtons and newton-metres at midship, home axes, for a motion in SI.

        Parameters
        ----------
        motion : mapping
            See :func:`towtank.core.motion.scaled_state`.
        approach_speed : float or ndarray, optional
            U0 in m/s; the reference speed of the set when not given.

        Returns
        -------
        dict
            ``X``, ``Y``, ``N`` (and ``K``) for the components that the set has.
        """
        if self.conventions.force_scaling not in ("LT", "L2"):
            return self.to("lt").forces(motion, approach_speed=approach_speed)
        if approach_speed is None:
            approach_speed = self.reference_speed
        wanted = {variable for term in self.terms for variable in term.variables} | {"v"}
        state, speed = scaled_state(motion, self.ship, self.conventions, approach_speed, only=wanted)
        forces: dict[str, np.ndarray] = {}
        for term, value in zip(self.terms, self.values, strict=True):
            part = value * term.column(state)
            forces[term.component] = forces[term.component] + part if term.component in forces else part
        for component in forces:
            forces[component] = forces[component] * force_units(component, self.ship, self.conventions, speed)
        lever = origin_position(self.conventions, self.ship) * self.ship.L
        if lever and "N" in forces and "Y" in forces:
            forces["N"] = forces["N"] + lever * forces["Y"]
        return forces

    def extrapolates(self, **ranges: tuple[float, float]) -> list[str]:
        """Sentences for each variable whose wanted range leaves the range of the data."""
        messages = []
        for variable, (low, high) in ranges.items():
            if variable not in self.validity:
                continue
            lower, upper = self.validity[variable]
            if low < lower - 1e-9 or high > upper + 1e-9:
                messages.append(
                    f"{variable} from {low:.3g} to {high:.3g} leaves the measured range {lower:.3g} to {upper:.3g}"
                )
        return messages

    # -- writing ---------------------------------------------------------------------------------------------

    def to_dict(self) -> dict[str, Any]:
        """Everything, for JSON; :meth:`from_dict` returns the same set bit for bit."""
        from .derivative_json import set_to_dict

        return set_to_dict(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> DerivativeSet:
        """Set from :meth:`to_dict`."""
        from .derivative_json import set_from_dict

        return set_from_dict(data)

    def to_json(self, path: Any = None) -> str:
        """JSON text; written to `path` when given."""
        from .derivative_json import write_json

        return write_json(self, path)

    @classmethod
    def from_json(cls, source: Any) -> DerivativeSet:
        """Set from a JSON file (path) or JSON text.

        Raises
        ------
        ReadError
            When the file is missing or is not a derivative set.
        """
        from .derivative_json import read_json

        return read_json(source)

    def to_csv(self, path: Any) -> None:
        """Table of :meth:`to_frame` as CSV."""
        self.to_frame().to_csv(path, index=False)

    def to_excel(self, path: Any) -> None:
        """Workbook with the table, the covariance and the conventions."""
        import pandas as pd

        rows = pd.DataFrame(self.conventions.describe(), columns=["convention", "choice", "meaning"])
        with pd.ExcelWriter(path, engine="openpyxl") as book:
            self.to_frame().to_excel(book, sheet_name="derivatives", index=False)
            self.cov_params().to_excel(book, sheet_name="covariance")
            rows.to_excel(book, sheet_name="conventions", index=False)

    def to_latex(self, path: Any = None) -> str:
        """LaTeX table; written to `path` when given."""
        from .derivative_table import latex_table

        text = latex_table(self)
        if path is not None:
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(text)
        return text


def joined(sets: Sequence[DerivativeSet], name: str) -> DerivativeSet:
    """One set from the disjoint terms of several in the same conventions; covariances become blocks."""
    first = sets[0]
    size = sum(len(part) for part in sets)
    covariance = np.zeros((size, size))
    position = 0
    known = all(part.covariance is not None for part in sets)
    for part in sets:
        if part.conventions != first.conventions:
            raise TermError(f"'{part.name}' and '{first.name}' differ in convention", cure="convert one of them")
        if part.covariance is not None:
            covariance[position : position + len(part), position : position + len(part)] = part.covariance
        position += len(part)
    return replace(
        first,
        name=name,
        terms=tuple(term for part in sets for term in part.terms),
        values=np.concatenate([part.values for part in sets]),
        covariance=covariance if known else None,
        dof=min(part.dof for part in sets),
    )
