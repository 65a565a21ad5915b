"""Folders of results of solver logs: loads and campaign table as read, means and verdicts as settled."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from ..cfd.case_loads import CaseLoads, LoadChoices
from ..cfd.case_sweep import CaseSweep
from ..cfd.cycles_table import cycles_table
from ..cfd.settled_loads import SettledCase, points_table, settled_table, settling_findings
from ..core.findings import Finding
from ..core.provenance import program_versions
from .cfd_settling_tables import load_table, settling_facts, verdict_table
from .drawings import Drawing, Row
from .page_template import page_environment
from .provenance_tables import findings_table, versions_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder

if TYPE_CHECKING:
    import pandas as pd

READ_FORMAT = "towtank cfd-loads 1"
SETTLED_FORMAT = "towtank cfd-settled 1"

MOST_COLUMNS = 8
"""Columns of a history of probes or the like that are drawn."""

MOST_DRAWN = 12
"""Cases that are drawn; those that have not settled come first."""

HERE = Path(__file__).parent


def require_cfd_folder(out: str | Path, *, settled: bool) -> None:
    """Refuse a folder that cannot take the results; see :func:`~towtank.report.result_folder.require_folder`."""
    require_folder(Path(out), SETTLED_FORMAT if settled else READ_FORMAT)


def campaign_table(sweep: CaseSweep, loads: Sequence[CaseLoads]) -> pd.DataFrame:
    """One row a case: parameters, how long it is, and what the reader found."""
    frame = sweep.to_frame()
    steps = [float(item.time[-1] - item.time[0]) / max(item.time.size - 1, 1) for item in loads]
    frame["rows"] = [item.time.size for item in loads]
    frame["start"] = [float(item.time[0]) for item in loads]
    frame["end"] = [float(item.time[-1]) for item in loads]
    frame["mean step"] = steps
    frame["counts"] = [item.index_name for item in loads]
    frame["restarts"] = [item.restarts for item in loads]
    frame["diverged at"] = [float("nan") if item.diverged_at is None else item.diverged_at for item in loads]
    frame["loads"] = [" ".join(item.channels) for item in loads]
    return frame


def loads_table(loads: Sequence[CaseLoads]) -> pd.DataFrame:
    """All histories below each other, with the name of the case in the first column."""
    import pandas as pd

    frames = []
    for item in loads:
        frame = item.to_frame()
        frame.insert(0, "case", item.name)
        frames.append(frame)
    return pd.concat(frames, ignore_index=True)


def write_loads(
    sweep: CaseSweep,
    loads: Sequence[CaseLoads],
    choices: LoadChoices,
    out: str | Path,
    *,
    progress: Progress | None = None,
) -> list[Path]:
    """Write ``campaign.csv``, ``loads.csv`` and ``provenance.json``.

    Parameters
    ----------
    sweep : CaseSweep
    loads : sequence of CaseLoads
        One a case of the sweep.
    choices : LoadChoices
    out : str or Path
    progress : callable, optional

    Raises
    ------
    TowtankError
        When `out` cannot be written to or holds results of another kind.
    """
    writers: list[tuple[str, Writer]] = [
        ("campaign.csv", csv_writer(lambda: campaign_table(sweep, loads))),
        ("loads.csv", csv_writer(lambda: loads_table(loads))),
    ]
    provenance = read_provenance(READ_FORMAT, loads, choices, sweep.findings)
    return write_folder(Path(out), writers, provenance, progress)


def write_settled(
    sweep: CaseSweep,
    cases: Sequence[SettledCase],
    choices: LoadChoices,
    out: str | Path,
    *,
    report: bool = True,
    progress: Progress | None = None,
) -> list[Path]:
    """Write ``settled.csv``, ``cycles.csv``, ``points.csv``, ``report.html`` and ``provenance.json``.

    ``cycles.csv`` holds the harmonics of periodic loads cycle by cycle; it is left out where none is periodic.
    ``points.csv`` holds the means as points of a captive campaign; it is left out while a case has not settled and is
    not waived, and for histories that are no loads.

    Parameters
    ----------
    sweep : CaseSweep
    cases : sequence of SettledCase
    choices : LoadChoices
    out : str or Path
    report : bool
    progress : callable, optional

    Raises
    ------
    TowtankError
        When `out` cannot be written to or holds results of another kind.
    """
    findings = [*sweep.findings, *settling_findings(cases)]
    parameters = sweep.to_frame().drop(columns="case")
    named = parameters.assign(case=[case.name for case in sweep.cases])
    writers: list[tuple[str, Writer]] = [
        ("settled.csv", csv_writer(lambda: settled_table(cases).merge(named, on="case", how="left")))
    ]
    if any(channel.cycles is not None for item in cases for channel in item.settling.channels):
        writers.append(("cycles.csv", csv_writer(lambda: cycles_table(cases))))
    of_loads = not any(item.loads.history for item in cases)
    if of_loads and not any(item.severity == "error" and not item.accepted for item in findings):
        writers.append(("points.csv", csv_writer(lambda: points_table(cases))))
    if report:
        writers.append(
            (
                "report.html",
                lambda path: path.write_text(
                    render_settling_report(cases, findings, progress=progress), encoding="utf-8"
                ),
            )
        )
    provenance = read_provenance(SETTLED_FORMAT, [item.loads for item in cases], choices, findings)
    return write_folder(Path(out), writers, provenance, progress)


def render_settling_report(
    cases: Sequence[SettledCase],
    findings: Sequence[Finding],
    *,
    created: datetime | None = None,
    progress: Progress | None = None,
) -> str:
    """The page of settled runs as HTML, which needs nothing beside itself.

    Parameters
    ----------
    cases : sequence of SettledCase
    findings : sequence of Finding
    created : datetime, optional
        Time that the page carries; now when not given.
    progress : callable, optional
    """
    moment = (created or datetime.now(UTC)).astimezone(UTC)
    drawn = drawn_cases(cases)
    rows = []
    for number, item in enumerate(drawn):
        if progress:
            progress("drawing", number, len(drawn))
        rows.append((item, settling_row(item, f"c{number + 1}"), load_table(item)))
    page: dict[str, Any] = {
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((HERE / "report.css").read_text(encoding="utf-8")),
        "facts": settling_facts(cases),
        "verdicts": verdict_table(cases),
        "history": next((item.loads.history for item in cases), ""),
        "rows": rows,
        "left_out": len(cases) - len(drawn),
        "steps": [(item.case.name, item.loads.steps, item.loads.notes) for item in drawn],
        "findings": findings_table(dict.fromkeys(findings)),
        "versions": versions_text(program_versions()),
        "virtual": any((item.case.path.parent / "truth.json").is_file() for item in cases),
    }
    return page_environment().get_template("cfd_settling.html.j2").render(page)


def drawn_cases(cases: Sequence[SettledCase], most: int = MOST_DRAWN) -> list[SettledCase]:
    """The cases that are drawn: all that have not settled first, in their order."""
    order = {"diverged": 0, "still drifting": 1, "too short": 2}
    return sorted(cases, key=lambda item: order.get(item.verdict, 3))[:most]


def settling_row(item: SettledCase, prefix: str) -> Row:
    """History and running mean of each fitted load of a case; amplitudes cycle by cycle for a periodic one."""
    # drawing needs matplotlib, which the command line must not load at its start
    from .cfd_settling_figures import cycle_figure, phase_figure, running_mean_figure
    from .figure_style import inline_svg

    drawings: list[Drawing] = []
    kinds = {"mean": running_mean_figure, "cycles": cycle_figure, "phase": phase_figure}
    told = {"mean": "history and running mean", "cycles": "each cycle", "phase": "mean cycle"}
    for name in item.fitted[:MOST_COLUMNS]:
        for kind, draw in kinds.items():
            if kind != "mean" and item[name].cycles is None:
                continue
            axes = draw(item, name)
            whole = axes.get_figure(root=True)
            assert whole is not None
            text = f"{name} of {item.case.name}: {told[kind]}"
            drawings.append(Drawing(inline_svg(whole, f"{prefix}-{len(drawings)}-{kind}", text)))
    return Row(item.case.name, tuple(drawings), item.settling.note)


def read_provenance(
    kind: str, loads: Sequence[CaseLoads], choices: LoadChoices, findings: Sequence[Finding]
) -> dict[str, Any]:
    """Provenance of what was read from cases: choices, and of each history its files, steps and notes.

    Parameters
    ----------
    kind : str
        Format of the folder.
    loads : sequence of CaseLoads
    choices : LoadChoices
    findings : sequence of Finding
    """
    return {
        "format": kind,
        "created": timestamp(),
        "versions": program_versions(),
        "choices": vars(choices),
        "conventions": loads[0].conventions.to_dict() if loads else {},
        "cases": {
            f"{item.name}/{item.history}" if item.history else item.name: {
                "files": list(item.files),
                "steps": list(item.steps),
                "notes": list(item.notes),
            }
            for item in loads
        },
        "findings": [vars(item) for item in findings],
    }
