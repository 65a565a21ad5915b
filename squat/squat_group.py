"""Runs in calm water at one depth: their curve, its fits, the formulas beside it, and the curve corrected."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..core.errors import CampaignError, TowtankError
from ..core.findings import Finding
from ..core.ship import Ship
from .formula_comparison import FormulaComparison, beside_formulas
from .named_corrections import ShipInWater, correct_curve
from .squat_campaign import SquatCampaign
from .squat_curve import CurveFit, SquatCurve
from .squat_run import SquatRun


@dataclass(frozen=True, eq=False)
class SquatGroup:
    """Runs in calm water at one depth.

    Attributes
    ----------
    curve : SquatCurve
        One point a run, repeats included.
    fits : mapping of str to mapping of str to CurveFit
        By quantity, then by model.
    failures : mapping of str to str
        Curves that could not be fitted, by ``quantity, model``.
    comparison : FormulaComparison, optional
    corrected : SquatCurve, optional
        The curve with the correction of the campaign added.
    """

    curve: SquatCurve
    fits: Mapping[str, Mapping[str, CurveFit]]
    failures: Mapping[str, str]
    comparison: FormulaComparison | None = None
    corrected: SquatCurve | None = None

    @property
    def failure_lines(self) -> tuple[tuple[str, str], ...]:
        """Failures as (what, reason), those of one reason together."""
        reasons = dict.fromkeys(self.failures.values())
        return tuple(
            ("; ".join(what for what, why in self.failures.items() if why == reason), reason) for reason in reasons
        )

    @property
    def label(self) -> str:
        """Depth in m and over the draught."""
        return f"depth {self.curve.depth:g} m, h/T {self.curve.depth / self.curve.draught:.3g}"


def squat_groups(campaign: SquatCampaign, runs: Sequence[SquatRun], found: list[Finding]) -> Iterator[SquatGroup]:
    """One group a depth of the runs in calm water; what is missing for a curve joins `found`.

    Parameters
    ----------
    campaign : SquatCampaign
    runs : sequence of SquatRun
    found : list of Finding
        Is added to.

    Raises
    ------
    CampaignError
        When the correction of the campaign cannot be added.
    """
    calm = [one for run in runs if run.waves is None for one in run.steady]
    ship = campaign.make_ship()
    lacking = [
        what
        for what, missing in (
            ("the ship's particulars", ship is None),
            ("the speed", any("speed" not in one.means for one in calm)),
            ("the water depth", any(one.depth is None for one in calm)),
            ("sinkage at bow and stern", any("sinkage_bow" not in one.means for one in calm)),
        )
        if missing
    ]
    if not calm:
        return
    if lacking or ship is None:
        found.append(
            Finding(
                "no-curve",
                "info",
                f"no curve over speed: {', '.join(lacking)} not given",
                cure="give ship, depth and the speed channel",
            )
        )
        return
    for depth in dict.fromkeys(one.depth for one in calm):
        members = [one for one in calm if one.depth == depth]
        curve = SquatCurve.from_runs(members, ship.T, name=campaign.squat.name, scale=campaign.scale)
        fits, failures = _fits(campaign, curve)
        comparison = _comparison(campaign, curve, ship, found)
        yield SquatGroup(curve, fits, failures, comparison, _corrected(campaign, curve, ship))


def _fits(campaign: SquatCampaign, curve: SquatCurve) -> tuple[dict[str, dict[str, CurveFit]], dict[str, str]]:
    fits: dict[str, dict[str, CurveFit]] = {}
    failures: dict[str, str] = {}
    if len(curve.points) < 2:
        return fits, failures
    for name in curve.points.columns:
        quantity = str(name)
        if quantity != "trim" and not (quantity.startswith("sinkage_") and not quantity.endswith("_se")):
            continue
        for model in campaign.fit.models:
            try:
                fits.setdefault(quantity, {})[model] = curve.fit(quantity, model)
            except TowtankError as error:
                failures[f"{quantity}, {model}"] = error.cause
    return fits, failures


def _comparison(
    campaign: SquatCampaign, curve: SquatCurve, ship: Ship, found: list[Finding]
) -> FormulaComparison | None:
    if not campaign.output.formulas:
        return None
    if ship.volume is None and ship.displacement_mass is None:
        found.append(
            Finding("no-formulas", "info", "no formulas: the ship has no displaced volume", cure="give volume")
        )
        return None
    try:
        compared = beside_formulas(
            curve,
            ship,
            channel=campaign.fairway.make_fairway(curve.depth),
            **campaign.hull.model_dump(),
        )
    except TowtankError as error:
        found.append(Finding("no-formulas", "warning", f"no formulas: {error.cause}", cure=error.cure))
        return None
    found.extend(compared.findings)
    return compared


def _corrected(campaign: SquatCampaign, curve: SquatCurve, ship: Ship) -> SquatCurve | None:
    chosen = campaign.correction
    if chosen is None:
        return None
    water = ShipInWater.of(
        ship,
        campaign.fairway.make_fairway(curve.depth),
        campaign.hull.midship_coefficient,
        **chosen.particulars,
    )
    try:
        return correct_curve(curve, chosen.name, water, to=chosen.to, guarded=chosen.guarded)
    except TowtankError as error:
        lacking = error.cause.rpartition(" needs ")[2]
        cure = f"add {_WHERE.get(lacking, f'{lacking} to [correction]')}" if "needs" in error.cause else error.cure
        raise CampaignError(error.cause, cure=cure, place=f"correction {chosen.name}") from None


_WHERE = {
    "section": "the width of the tank (--width, or width in [fairway])",
    "width": "the width of the tank (--width, or width in [fairway])",
    "volume": "volume to [ship]",
    "block_coefficient": "volume to [ship]",
}
"""Where a campaign has what a correction asks for."""
