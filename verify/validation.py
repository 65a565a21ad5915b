"""Validation: is the comparison error smaller than what is known of simulation and measurement together?

S is the simulation, D the data. The comparison error E = S - D of ASME V&V 20 is D - S in ITTC 7.5-03-01-01; papers
also print both in per cent of D. All four stand beside each other under their names here.

Uncertainties U are expanded: coverage factor k times the standard uncertainty u, k = 2 (about 95 %) unless another is
given. U_D belongs to the measurement, U_SN to the numerical solution (grid, time step, iteration), U_input to the
inputs of the simulation that are known from the experiment only (speed, mass, wave height)::

    U_V^2 = U_D^2 + U_SN^2 + U_input^2 - 2 k^2 cov(S, D)

ITTC 7.5-03-01-01 has the first two terms, ASME V&V 20-2009 the third (section 5) and the covariance where S and D use
the same measured quantity. |E| < U_V: validated at the level U_V. Otherwise E is larger than the noise, and the
modelling error lies between E - U_V and E + U_V.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from ..core.errors import TowtankError

if TYPE_CHECKING:
    import pandas as pd

COVERAGE = 2.0
"""Coverage factor of the uncertainties when none is given: 95 % of a normal distribution."""

Verdict = Literal["validated", "not validated", "not judged"]

ERROR_FORMS = ("S-D", "D-S", "(S-D)/D [%]", "(D-S)/D [%]")
"""Sign conventions of the comparison error, by name."""

VALIDATION_COLUMNS = (
    "quantity",
    "S",
    "D",
    "unit",
    *ERROR_FORMS,
    "U_SN",
    "U_input",
    "U_D",
    "U_V",
    "U_V/|D| [%]",
    "z",
    "verdict",
    "level",
    "model_error_low",
    "model_error_high",
    "note",
)
"""Columns of :func:`validate_table`."""


@dataclass(frozen=True)
class Validation:
    """One simulated value against its measurement.

    Attributes
    ----------
    quantity, unit : str
    simulation, data : float
        S and D.
    U_D, U_SN, U_input : float
        Expanded uncertainties of the measurement, the numerical solution and the inputs; NaN when unknown.
    covariance : float
        Covariance of S and D from what both share.
    coverage : float
        Coverage factor k of the expanded uncertainties.
    required : float or None
        Uncertainty that the use of the result can bear, U_reqd of ITTC.
    notes : tuple of str
    """

    quantity: str
    simulation: float
    data: float
    unit: str = ""
    U_D: float = math.nan
    U_SN: float = math.nan
    U_input: float = 0.0
    covariance: float = 0.0
    coverage: float = COVERAGE
    required: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def error(self) -> float:
        """E = S - D, the convention of ASME V&V 20."""
        return self.simulation - self.data

    @property
    def errors(self) -> dict[str, float]:
        """The comparison error in every convention of :data:`ERROR_FORMS`; per cent are NaN where D is zero."""
        percent = 100.0 * self.error / self.data if self.data else math.nan
        return dict(zip(ERROR_FORMS, (self.error, 0.0 - self.error, percent, 0.0 - percent), strict=True))

    @property
    def U_V(self) -> float:
        """Validation uncertainty; NaN when a part of it is unknown."""
        if not self.known:
            return math.nan
        squares = self.U_D**2 + self.U_SN**2 + self.U_input**2
        left = squares - 2.0 * self.coverage**2 * self.covariance
        # what S and D share entirely leaves rounding only
        return math.sqrt(left) if left > 1e-12 * squares else 0.0

    @property
    def known(self) -> bool:
        """Whether all three uncertainties are known."""
        return all(math.isfinite(value) for value in (self.U_D, self.U_SN, self.U_input))

    @property
    def z(self) -> float:
        """E over the standard validation uncertainty U_V / k; NaN when that is unknown or zero."""
        return self.coverage * self.error / self.U_V if self.known and self.U_V > 0.0 else math.nan

    @property
    def verdict(self) -> Verdict:
        """Validated when |E| < U_V; not judged when a part of U_V is unknown."""
        if not self.known:
            return "not judged"
        return "validated" if abs(self.error) < self.U_V or self.error == 0.0 else "not validated"

    @property
    def level(self) -> float:
        """Level of validation: U_V when validated, |E| when not, NaN when not judged."""
        return {"validated": self.U_V, "not validated": abs(self.error), "not judged": math.nan}[self.verdict]

    @property
    def model_error(self) -> tuple[float, float]:
        """Interval of the modelling error, E - U_V to E + U_V."""
        return self.error - self.U_V, self.error + self.U_V

    @property
    def sentence(self) -> str:
        """The verdict in words, with its level."""
        unit = f" {self.unit}" if self.unit and self.unit != "-" else ""
        if self.verdict == "not judged":
            return f"not judged: {'; '.join(self.notes) or 'an uncertainty is unknown'}"
        of_data = f" ({100.0 * self.level / abs(self.data):.3g} % of D)" if self.data else ""
        if self.verdict == "validated":
            text = f"validated at level U_V = {self.U_V:.4g}{unit}{of_data}"
        else:
            low, high = self.model_error
            text = (
                f"not validated: |E| = {abs(self.error):.4g}{unit}{of_data} exceeds U_V = {self.U_V:.4g}; "
                f"modelling error between {low:.4g} and {high:.4g}{unit}"
            )
        if self.required is not None:
            enough = self.level <= self.required
            text += f"; {'within' if enough else 'beyond'} the required {self.required:.4g}{unit}"
        return text


def validate_value(
    simulation: float,
    data: float,
    *,
    U_D: float = math.nan,
    U_SN: float = math.nan,
    U_input: float = 0.0,
    covariance: float = 0.0,
    coverage: float = COVERAGE,
    required: float | None = None,
    quantity: str = "",
    unit: str = "",
) -> Validation:
    """Validate one simulated value.

    Parameters
    ----------
    simulation, data : float
        S and D, in one unit. Where the numerical error was estimated with its sign, give the corrected S and the
        uncertainty of the correction as `U_SN` (ITTC: S_C and U_SCN).
    U_D, U_SN, U_input : float
        Expanded uncertainties in that unit; NaN when unknown, 0 when known to be nothing.
    covariance : float
        Covariance of S and D, :func:`~towtank.verify.input_uncertainty.shared_inputs`.
    coverage : float
        Coverage factor of the three.
    required : float, optional
        Uncertainty that the use of the result can bear.
    quantity, unit : str

    Returns
    -------
    Validation

    Raises
    ------
    TowtankError
        When S or D is no number, an uncertainty is negative, or the coverage factor is not positive.
    """
    place = f"quantity {quantity}" if quantity else ""
    for name, value in (("S", simulation), ("D", data)):
        if not math.isfinite(value):
            raise TowtankError(f"{name} is no number ({value})", cure="give a value or drop the row", place=place)
    limit = 0.0 if required is None else required
    parts = {"U_D": U_D, "U_SN": U_SN, "U_input": U_input}
    for name, value in (parts | {"the required uncertainty": limit}).items():
        if value < 0.0:
            raise TowtankError(
                f"{name} is negative ({value:g})", cure="give the half width of the interval", place=place
            )
    if not coverage > 0.0:
        raise TowtankError(
            f"the coverage factor {coverage:g} is not positive", cure="give 2 for 95 %", place=place
        )
    largest = U_D * math.hypot(U_SN, U_input) / coverage**2
    if math.isfinite(largest) and abs(covariance) > largest * (1.0 + 1e-9):
        raise TowtankError(
            f"the covariance {covariance:g} is larger than the uncertainties of S and D allow ({largest:g})",
            cure="give the covariance of standard uncertainties",
            place=place,
        )
    notes = [f"{name} is unknown" for name, value in parts.items() if math.isnan(value)]
    if data == 0.0:
        notes.append("D is zero: no error in per cent")
    if U_D == U_SN == U_input == 0.0:
        notes.append("all uncertainties are zero")
    return Validation(
        quantity=quantity,
        simulation=float(simulation),
        data=float(data),
        unit=unit,
        U_D=float(U_D),
        U_SN=float(U_SN),
        U_input=float(U_input),
        covariance=float(covariance),
        coverage=float(coverage),
        required=required,
        notes=tuple(notes),
    )


def validate_table(
    simulation: pd.DataFrame,
    data: pd.DataFrame,
    *,
    coverage: float = COVERAGE,
    covariance: Mapping[str, float] | None = None,
    required: float | Mapping[str, float] | None = None,
) -> pd.DataFrame:
    """Validate every quantity that two tables share.

    Parameters
    ----------
    simulation, data : DataFrame
        Columns ``quantity``, ``value`` and, where known, ``uncertainty`` (expanded; U_SN and U_D), ``unit`` and, in the
        simulation, ``input_uncertainty`` (U_input; 0 without the column).
    coverage : float
        Coverage factor of the uncertainties.
    covariance : mapping of str to float, optional
        Covariance of S and D by quantity.
    required : float or mapping of str to float, optional
        Uncertainty that the use can bear, for all or by quantity.

    Returns
    -------
    DataFrame
        Columns :data:`VALIDATION_COLUMNS`, in the order of `data`. ``attrs``: ``coverage``, ``only_simulation``,
        ``only_data``, ``sentences`` (the verdicts in words).

    Raises
    ------
    TowtankError
        When the tables share no quantity, name one twice, differ in a unit, or hold what :func:`validate_value`
        refuses.
    """
    first, second = _rows(simulation, "simulation"), _rows(data, "data")
    common = [name for name in second if name in first]
    if not common:
        raise TowtankError(
            f"simulation and data share no quantity: {_some(first)} against {_some(second)}",
            cure="name the quantities alike",
        )
    results = []
    for name in common:
        s, d = first[name], second[name]
        limit = required.get(name) if isinstance(required, Mapping) else required
        results.append(
            validate_value(
                s["value"],
                d["value"],
                U_D=d["uncertainty"],
                U_SN=s["uncertainty"],
                U_input=s["input_uncertainty"],
                covariance=(covariance or {}).get(name, 0.0),
                coverage=coverage,
                required=limit,
                quantity=name,
                unit=_one_unit(name, str(s["unit"]), str(d["unit"])),
            )
        )
    frame = validation_frame(results)
    frame.attrs |= {
        "only_simulation": [name for name in first if name not in second],
        "only_data": [name for name in second if name not in first],
    }
    return frame


def validation_frame(results: list[Validation]) -> pd.DataFrame:
    """Validations as a table with :data:`VALIDATION_COLUMNS`; ``attrs``: coverage, sentences."""
    import pandas as pd

    rows = []
    for one in results:
        low, high = one.model_error
        size = abs(one.data)
        rows.append(
            {
                "quantity": one.quantity,
                "S": one.simulation,
                "D": one.data,
                "unit": one.unit,
                **one.errors,
                "U_SN": one.U_SN,
                "U_input": one.U_input,
                "U_D": one.U_D,
                "U_V": one.U_V,
                "U_V/|D| [%]": 100.0 * one.U_V / size if size else math.nan,
                "z": one.z,
                "verdict": one.verdict,
                "level": one.level,
                "model_error_low": low,
                "model_error_high": high,
                "note": "; ".join(one.notes),
            }
        )
    frame = pd.DataFrame(rows, columns=list(VALIDATION_COLUMNS))
    frame.attrs = {
        "coverage": results[0].coverage if results else COVERAGE,
        "sentences": {one.quantity: one.sentence for one in results},
        "only_simulation": [],
        "only_data": [],
        "notes": [],
    }
    return frame


def _rows(table: pd.DataFrame, what: str) -> dict[str, dict[str, Any]]:
    """Rows of a table by quantity, columns that it has not filled in."""
    for column in ("quantity", "value"):
        if column not in table:
            raise TowtankError(
                f"the table of the {what} has no column '{column}'",
                cure=f"it has {', '.join(map(str, table.columns))}; name them quantity,value,uncertainty,unit",
            )
    rows: dict[str, dict[str, Any]] = {}
    defaults = {"uncertainty": math.nan, "input_uncertainty": 0.0}
    for row in table.to_dict("records"):
        name = str(row["quantity"])
        if name in rows:
            raise TowtankError(f"the {what} names {name} twice", cure="keep one row", place=f"quantity {name}")
        numbers = {key: float(row.get(key, default)) for key, default in defaults.items()}
        unit = row.get("unit", "")
        rows[name] = {"value": float(row["value"]), **numbers, "unit": unit if isinstance(unit, str) else ""}
    return rows


def _one_unit(quantity: str, of_simulation: str, of_data: str) -> str:
    """Unit that both name; an error when they differ."""
    if of_simulation and of_data and of_simulation != of_data:
        raise TowtankError(
            f"simulation in '{of_simulation}', data in '{of_data}'",
            cure="give both in one unit",
            place=f"quantity {quantity}",
        )
    return of_data or of_simulation


def _some(rows: Mapping[str, Any]) -> str:
    names = list(rows)
    return ", ".join(names[:4]) + (", ..." if len(names) > 4 else "")
