"""All decay estimators behind one interface, and one table of what they say."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError, TowtankError
from .damping_models import DampingModel, damping_model
from .decay_record import DecayRecord
from .equivalent_damping import EquivalentDamping
from .fit_assessment import as_records
from .roll_damping import RollDamping

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class DecayMethod:
    """One estimator.

    Attributes
    ----------
    module, function : str
        Where it stands in this room; imported when it is used.
    linear_only : bool
        Whether it describes one record by linear damping, so that the comparison gives it the linear model.
    exact : bool
        Whether it finds the coefficients of a noise-free decay exactly.
    """

    module: str
    function: str
    linear_only: bool = False
    exact: bool = False


#: Estimators by name, the simplest first.
METHODS: dict[str, DecayMethod] = {
    "logarithmic decrement": DecayMethod("logarithmic_decrement", "fit_logarithmic_decrement"),
    "exponential cosine": DecayMethod("exponential_cosine", "fit_exponential_cosine", linear_only=True),
    "extinction curve": DecayMethod("extinction_curve", "fit_extinction_curve"),
    "quasi-linear": DecayMethod("quasi_linear", "fit_quasi_linear"),
    "energy method": DecayMethod("energy_method", "fit_energy_method", exact=True),
    "derivation": DecayMethod("derivation_fit", "fit_derivation", exact=True),
    "curve, then least squares": DecayMethod("smooth_curve_fit", "fit_smooth_curve"),
    "NLS-SVM": DecayMethod("nls_svm", "fit_nls_svm"),
    "integration": DecayMethod("integration_fit", "fit_integration", exact=True),
}
#: The method used when none is named: exact for noise-free records, and with the narrowest honest intervals.
DEFAULT_METHOD = "integration"


def fit_decay(
    records: DecayRecord | Sequence[DecayRecord],
    model: DampingModel | None = None,
    *,
    method: str = DEFAULT_METHOD,
    **options: Any,
) -> RollDamping:
    """Damping by the named method.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
        Free parts, centred.
    model : DampingModel, optional
        The method's own default when not given.
    method : str
        One of `METHODS`.
    **options
        Of the method's own function.

    Raises
    ------
    FitError
        For an unknown method or option, or when the fit is not possible.
    """
    return _function(method)(records, model, **options)


def _function(method: str) -> Callable[..., RollDamping]:
    try:
        chosen = METHODS[method]
    except KeyError:
        raise FitError(f"method '{method}' is unknown", cure=f"use one of {', '.join(METHODS)}") from None
    function: Callable[..., RollDamping] = getattr(
        import_module(f".{chosen.module}", __package__), chosen.function
    )
    return function


@dataclass(frozen=True, eq=False)
class DecayComparison:
    """What several methods say about the same records.

    Attributes
    ----------
    results : mapping of str to RollDamping
        By method.
    failures : mapping of str to str
        Methods that raised, with the reason.
    """

    results: Mapping[str, RollDamping]
    failures: Mapping[str, str]

    def __getitem__(self, method: str) -> RollDamping:
        try:
            return self.results[method]
        except KeyError:
            raise FitError(
                self.failures.get(method, f"method '{method}' was not run"),
                cure=f"there are results of {', '.join(self.results)}",
            ) from None

    def table(self) -> pd.DataFrame:
        """Coefficients of all methods: ``method, model, name, value, std, lower95, upper95, unit``."""
        import pandas as pd

        return pd.concat([one.table() for one in self.results.values()], ignore_index=True)

    def summary(self) -> pd.DataFrame:
        """One row a method: omega_n, zeta, R2, noise, whether it is to be trusted, and why not."""
        import pandas as pd

        rows = []
        for method, one in self.results.items():
            low, high = one.diagnostics.amplitudes
            at = one.equivalent(np.array([np.sqrt(low * high)]))
            rows.append(
                {
                    "method": method,
                    "model": one.model.label,
                    "omega_n [rad/s]": one.omega_n,
                    "zeta at the middle amplitude [-]": float(at.zeta[0]),
                    "std of zeta [-]": float(at.alpha_sd[0] / at.omega[0]),
                    "R2": one.diagnostics.r2,
                    "trusted": one.trusted,
                    "remarks": "; ".join(item.message for item in one.findings),
                }
            )
        rows += [{"method": name, "trusted": False, "remarks": reason} for name, reason in self.failures.items()]
        return pd.DataFrame(rows)

    def amplitudes(self, points: int = 25) -> np.ndarray:
        """Amplitudes common to all methods, shape (points,), in rad or m."""
        ranges = [one.diagnostics.amplitudes for one in self.results.values()]
        return np.linspace(max(low for low, _ in ranges), min(high for _, high in ranges), points)

    def equivalent(
        self, amplitude: np.ndarray | None = None, *, speed: float = 0.0
    ) -> dict[str, EquivalentDamping]:
        """Equivalent damping of each method at the same amplitudes."""
        at = self.amplitudes() if amplitude is None else amplitude
        return {method: one.equivalent(at, speed=speed) for method, one in self.results.items()}

    def equivalent_table(self, amplitude: np.ndarray | None = None, *, speed: float = 0.0) -> pd.DataFrame:
        """Equivalent damping of all methods below each other, with a column ``method``."""
        import pandas as pd

        frames = []
        for method, one in self.equivalent(amplitude, speed=speed).items():
            frame = one.to_frame()
            frame.insert(0, "method", method)
            frames.append(frame)
        return pd.concat(frames, ignore_index=True)


def compare_methods(
    records: DecayRecord | Sequence[DecayRecord],
    model: DampingModel | None = None,
    *,
    methods: Sequence[str] = tuple(METHODS),
    options: Mapping[str, Mapping[str, Any]] | None = None,
) -> DecayComparison:
    """Fit the same records by several methods.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
        Free parts, centred.
    model : DampingModel, optional
        Linear plus quadratic damping when not given. Methods that describe a record by linear damping get that.
    methods : sequence of str
        Names of `METHODS`.
    options : mapping of str to mapping, optional
        Options of single methods.

    Raises
    ------
    FitError
        For an unknown method, or when every method fails.
    """
    chosen = DampingModel() if model is None else model
    runs = as_records(records)
    results: dict[str, RollDamping] = {}
    failures: dict[str, str] = {}
    functions = {method: _function(method) for method in methods}
    for method, function in functions.items():
        own = chosen
        if METHODS[method].linear_only and len(runs) == 1:
            own = damping_model("linear", fixed={k: v for k, v in chosen.fixed.items() if k == "c1"})
        try:
            results[method] = function(runs, own, **(options or {}).get(method, {}))
        except TowtankError as error:
            failures[method] = str(error)
    if not results:
        first = next(iter(failures.items()), ("", "no method was named"))
        raise FitError(f"no method could fit the record; {first[0]}: {first[1]}", cure="see the record")
    return DecayComparison(results, failures)
