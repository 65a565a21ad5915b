"""The page of some manoeuvres."""

from __future__ import annotations

import math
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from markupsafe import Markup

from ..core.provenance import program_versions
from ..simulate.manoeuvring_results import ManoeuvringResults
from .manoeuvre_drawings import Figure
from .manoeuvre_section import manoeuvre_section
from .page_template import page_environment
from .provenance_tables import versions_text
from .ship_particulars import particulars
from .typography import fixed, significant

HERE = Path(__file__).parent


def render_manoeuvres(
    results: ManoeuvringResults, *, created: datetime | None = None, figures: list[Figure] | None = None
) -> str:
    """The page of some manoeuvres as HTML, which needs nothing beside itself.

    Parameters
    ----------
    results : ManoeuvringResults
    created : datetime, optional
        Time that the page carries; now when not given.
    figures : list of Figure, optional
        As :func:`~towtank.report.manoeuvre_drawings.manoeuvre_drawings` gives them.
    """
    moment = (created or datetime.now(UTC)).astimezone(UTC)
    vessel = results.vessel
    section = manoeuvre_section(results, "m", figures)
    page: dict[str, Any] = {
        "title": vessel.name,
        "source": vessel.hull.provenance.source,
        "misprints": vessel.hull.provenance.misprints,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((HERE / "report.css").read_text(encoding="utf-8")),
        "particulars": [*particulars([vessel.ship]), ("Approach speed U₀", significant(vessel.speed, 4), "m/s")],
        "facts": _facts(results),
        "m": section,
        "versions": versions_text(program_versions()),
    }
    return page_environment().get_template("manoeuvres.html.j2").render(page)


def _facts(results: ManoeuvringResults) -> list[tuple[str, str, str]]:
    frame = results.imo_frame()
    tested = frame[~frame["verdict"].isin(["not tested"])]
    passed = int((tested["verdict"] == "pass").sum())
    names = [one.manoeuvre for one in results.trajectories]
    rows = [("manoeuvres", str(len(names)), ", ".join(names))]
    if len(tested):
        margins = [(row["margin_pct"], row["criterion"]) for row in tested.to_dict("records")]
        known = [one for one in margins if not math.isnan(one[0])]
        detail = f"least margin {fixed(min(known)[0], 0)} %: {min(known)[1]}" if known else ""
        rows.append(("IMO criteria passed", f"{passed} of {len(tested)}", detail))
    if results.ensemble is not None:
        rows.append(("draws", str(results.ensemble.draws), results.ensemble.scatter.source))
    doubts = results.doubts()
    rows.append(("doubts", str(len(doubts)), "see the section" if doubts else "no range of validity was left"))
    return rows
