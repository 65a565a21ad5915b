"""``towtank cfd``: solver logs to loads, to means with a verdict on whether they settled, to derivatives."""

from __future__ import annotations

import json
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..core.errors import ReadError, TowtankError
from .campaign_commands import print_findings
from .derivative_source import load_derivatives
from .progress import progress_bar

if TYPE_CHECKING:
    from ..cfd.case_loads import LoadChoices, Point
    from ..cfd.case_sweep import CaseSweep
    from ..core.ship import Ship

Cases = Annotated[
    list[Path], typer.Argument(metavar="CASE...", help="Cases, or a folder whose subfolders are cases.")
]
Axes = Annotated[
    str,
    typer.Option(help="Solver axes: x-aft-z-up, x-forward-z-down, x-forward-z-up, x-aft-z-down (right-handed)."),
]
Density = Annotated[
    float | None, typer.Option(metavar="KG/M3", help="Density, where the solver prints force / density.")
]
Half = Annotated[bool, typer.Option("--half-model", help="Only one side of the hull was computed.")]
MomentPoint = Annotated[
    str | None,
    typer.Option(
        metavar="X,Y,Z", help="Point of the moments in solver coordinates, m; the file's CofR if not given."
    ),
]
Midship = Annotated[str, typer.Option(metavar="X,Y,Z", help="Midship in solver coordinates, m.")]
Turned = Annotated[
    bool, typer.Option("--hull-turned", help="The hull is turned by the drift angle, x runs along the track.")
]
Object = Annotated[str | None, typer.Option(help="Name of the force history, where a case has several.")]
Columns = Annotated[
    list[str] | None,
    typer.Option(
        "--column", metavar="LOAD=COLUMN", help="Column of a monitor file: Fx_total=Drag; may be repeated."
    ),
]
History = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        help="Another history than the forces: its name or kind (motion, probes, surface, residuals, monitor).",
    ),
]
Pattern = Annotated[
    str | None,
    typer.Option(help="Pattern of the names, e.g. b{drift_angle}_g{grid}; words such as beta_-4_grid2."),
]
CaseTable = Annotated[
    Path | None,
    typer.Option("--table", help="CSV with case, drift_angle, yaw_rate, speed, grid, time_step, cells."),
]
Cells = Annotated[str | None, typer.Option(metavar="GRID=N,...", help="Cells of each grid: 1=8000000,2=2828000.")]
Waive = Annotated[
    list[str] | None, typer.Option(metavar="CASE", help="Accept the verdict of a case; may be repeated.")
]
Out = Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the results.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print everything as JSON.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]


def register(app: typer.Typer) -> None:
    """Add the commands to `app`."""
    group = typer.Typer(
        help="Solver logs of a computation: read them, and say when they have settled.", no_args_is_help=True
    )
    group.command("read")(read)
    group.command("settle")(settle)
    group.command("study")(study)
    app.add_typer(group, name="cfd")


def read(
    cases: Cases,
    axes: Axes = "x-aft-z-up",
    density: Density = None,
    half_model: Half = False,
    moment_point: MomentPoint = None,
    midship: Midship = "0,0,0",
    hull_turned: Turned = False,
    object: Object = None,
    column: Columns = None,
    pattern: Pattern = None,
    table: CaseTable = None,
    cells: Cells = None,
    history: History = None,
    out: Out = None,
    json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Read the force histories of cases into home axes at midship, and list the cases as one campaign.

    OpenFOAM cases (with restarts), STAR-CCM+, Fluent and other monitor files. With --out: campaign.csv (one row a
    case), loads.csv (time, X, Y, Z, K, M, N and their pressure and viscous parts), provenance.json. With --history
    (a name, a kind or all): motions, probes, surface elevations, residuals as the solver prints them; histories.csv
    and one CSV a history.

    Examples: towtank cfd read sweep/ --density 998.8 --midship 3.5,0,0 --out loads; towtank cfd read case --history all
    """
    from ..cfd.settled_loads import read_case
    from ..core.findings import stop_on_error
    from ..report.cfd_settling_outputs import campaign_table, require_cfd_folder, write_loads
    from ..report.cfd_settling_tables import settled_records

    chosen = _choices(axes, density, half_model, moment_point, midship, hull_turned, object, column)
    if out is not None:
        require_cfd_folder(out, settled=False)
    sweep = _sweep(cases, pattern, table, cells)
    stop_on_error(sweep.findings)
    if history is not None:
        _read_histories(sweep, history, chosen, out, json, quiet)
        return
    with progress_bar(not quiet) as bar:
        loads = []
        for number, case in enumerate(sweep.cases):
            bar("reading", number, len(sweep.cases))
            loads.append(read_case(case, chosen))
        bar("reading", len(sweep.cases), len(sweep.cases))
        written = [] if out is None else write_loads(sweep, loads, chosen, out, progress=bar)
    if quiet:
        return
    frame = campaign_table(sweep, loads)
    if json:
        notes = {item.name: list(item.notes) for item in loads if item.notes}
        _print_json({"cases": settled_records(frame), "notes": notes, "findings": list(map(vars, sweep.findings))})
        return
    from ..report.aligned_text import aligned_text

    typer.echo(aligned_text(frame, list(frame.columns)))
    for item in loads:
        for note in item.notes:
            typer.echo(f"{item.name}: {note}")
    print_findings(sweep.findings)
    _print_written(out, written)


def _read_histories(
    sweep: CaseSweep, wanted: str, chosen: LoadChoices, out: Path | None, as_json: bool, quiet: bool
) -> None:
    """``towtank cfd read --history``: histories of cases that are no loads."""
    from ..cfd.case_history import histories_table, history_names, history_of
    from ..formats import read_solver_case
    from ..report.cfd_history_outputs import joined_overview, write_histories
    from ..report.cfd_settling_tables import settled_records

    channels = dict(chosen.columns) or None
    found, tables, notes = [], [], []
    with progress_bar(not quiet) as bar:
        for number, case in enumerate(sweep.cases):
            bar("reading", number, len(sweep.cases))
            solver = read_solver_case(case.path, channels=channels)
            names = history_names(solver, wanted)
            found += [history_of(solver, name, case.name) for name in names]
            overview = histories_table(solver, case.name)
            tables.append(overview[overview["history"].isin(names)])
            notes += [(case.name, note) for note in solver.notes]
        bar("reading", len(sweep.cases), len(sweep.cases))
        overview = joined_overview(tables)
        written = [] if out is None else write_histories(overview, found, chosen, out, progress=bar)
    notes += [(f"{item.name}, {item.history}", note) for item in found for note in item.notes]
    if quiet:
        return
    if as_json:
        _print_json({"histories": settled_records(overview), "notes": [list(note) for note in notes]})
        return
    from ..report.aligned_text import aligned_text

    short = overview.assign(columns=[_few(text.split(" "), " ") for text in overview["columns"]])
    short["points"] = [_few(text.split("; "), "; ") for text in overview["points"]]
    shown = [name for name in short.columns if name != "points" or any(short["points"])]
    typer.echo(aligned_text(short, shown))
    for name, note in dict.fromkeys(notes):
        typer.echo(f"{name}: {note}")
    _print_written(out, written)


def _few(words: list[str], between: str) -> str:
    """The first few of many names, and how many there are."""
    return between.join(words) if len(words) <= 4 else f"{between.join(words[:3])} ... ({len(words)})"


def settle(
    cases: Cases,
    axes: Axes = "x-aft-z-up",
    density: Density = None,
    half_model: Half = False,
    moment_point: MomentPoint = None,
    midship: Midship = "0,0,0",
    hull_turned: Turned = False,
    object: Object = None,
    column: Columns = None,
    pattern: Pattern = None,
    table: CaseTable = None,
    cells: Cells = None,
    omega: Annotated[
        float | None, typer.Option(help="Frequency of a forced motion, rad/s; found if not given.")
    ] = None,
    start: Annotated[float | None, typer.Option(help="Cut here instead of where the rules say, s.")] = None,
    waive: Waive = None,
    history: History = None,
    out: Out = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Say when each run settled, and give its means with their errors: settled, still drifting, periodic, diverged.

    With --out: settled.csv (mean, se, n_eff, cut_time, verdict, remaining_drift of every load), cycles.csv (periodic
    loads cycle by cycle), points.csv (points of a captive campaign; not while a case is unsettled and not waived),
    report.html, provenance.json. The exit status is 2 while a case is unsettled and not waived.

    Example: towtank cfd settle sweep/ --density 998.8 --midship 3.5,0,0 --out settled
    """
    from ..cfd.settled_loads import require_settled, settle_sweep, settled_table, settling_findings
    from ..formats.run_order import tells_run_order
    from ..report.cfd_settling_outputs import require_cfd_folder, write_settled
    from ..report.cfd_settling_tables import settled_records, settled_text

    chosen = _choices(axes, density, half_model, moment_point, midship, hull_turned, object, column)
    if omega is not None and not omega > 0.0:
        raise TowtankError(f"--omega {omega:g} is not positive", cure="give rad/s")
    if out is not None:
        require_cfd_folder(out, settled=True)
    sweep = _sweep(cases, pattern, table, cells)
    with progress_bar(not quiet) as bar:
        settled = settle_sweep(
            sweep, chosen, omega=omega, start=start, waive=waive or (), history=history or "", progress=bar
        )
        written = [] if out is None else write_settled(sweep, settled, chosen, out, report=report, progress=bar)
    findings = [*sweep.findings, *settling_findings(settled)]
    if json and not quiet:
        records = settled_records(settled_table(settled))
        _print_json({"settled": records, "findings": [vars(item) for item in findings]})
    elif not quiet:
        typer.echo(settled_text(settled))
        for item in settled:
            for note in item.loads.notes:
                if not tells_run_order(note):
                    typer.echo(f"{item.case.name}: {note}")
        print_findings(item for item in findings if item.accepted or item.severity != "error")
        _print_written(out, written)
    require_settled(settled)


def study(
    cases: Cases,
    ship: Annotated[
        str, typer.Option(help="TOML file with \\[ship], or a named ship, at the scale of the cases.")
    ],
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for the results.")],
    axes: Axes = "x-aft-z-up",
    density: Density = None,
    half_model: Half = False,
    moment_point: MomentPoint = None,
    midship: Midship = "0,0,0",
    hull_turned: Turned = False,
    object: Object = None,
    column: Columns = None,
    pattern: Pattern = None,
    table: CaseTable = None,
    cells: Cells = None,
    ratio: Annotated[
        float | None, typer.Option(help="Refinement ratio that was meant, checked against cells.")
    ] = None,
    efd: Annotated[
        str | None, typer.Option(help="Measured set: derivatives.json, results folder, published set.")
    ] = None,
    model: Annotated[
        str | None, typer.Option(help="Hull model; the terms that the motions call for if not given.")
    ] = None,
    method: Annotated[str, typer.Option(help="Method of the numerical uncertainty.")] = "default",
    waive: Waive = None,
    report: Annotated[bool, typer.Option(help="Write report.html.")] = True,
    json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Derivatives of a sweep on several grids with their numerical uncertainty, beside an experiment.

    Settles every case, fits each grid, and combines: derivatives.csv and .json, grid_derivatives.csv, uncertainty.csv,
    validation.csv, comparison.csv, settled.csv, report.html, provenance.json; the campaign of each grid in OUT-fits.

    Example: towtank cfd study sweep/ --ship kvlcc2 --cells 1=8000000,2=2828000,3=1000000 --efd kvlcc2 --out study
    """
    from ..cfd.grid_study import grid_study, load_truth
    from ..cfd.settled_loads import require_settled, settle_sweep
    from ..report.cfd_grid_outputs import require_grid_study_folder, write_grid_study
    from ..report.cfd_grid_tables import grid_study_text
    from ..report.cfd_settling_tables import settled_records

    chosen = _choices(axes, density, half_model, moment_point, midship, hull_turned, object, column)
    require_grid_study_folder(out)
    hull = _ship(ship)
    reference = None if efd is None else load_derivatives(efd)
    sweep = _sweep(cases, pattern, table, cells)
    fits = out.with_name(f"{out.name}-fits")
    # Campaigns appear when everything has worked: a fit that fails leaves nothing behind.
    with progress_bar(not quiet) as bar, tempfile.TemporaryDirectory(prefix="towtank-") as place:
        settled = settle_sweep(sweep, chosen, waive=waive or (), progress=bar)
        require_settled(settled)
        found = grid_study(
            settled,
            hull,
            Path(place),
            name=f"{hull.name}, computed on {len(sweep.grids)} grids",
            assumed_ratio=ratio,
            fit=None if model is None else {"model": model},
            method=method,
            reference=reference,
            truth=load_truth(sweep.cases[0].path.parent),
            progress=bar,
        )
        written = write_grid_study(found, out, report=report, progress=bar)
        shutil.copytree(place, fits, dirs_exist_ok=True)
    if quiet:
        return
    if json:
        findings = [vars(item) for item in found.findings]
        _print_json({"derivatives": settled_records(found.table()), "findings": findings})
        return
    typer.echo(grid_study_text(found))
    print_findings(found.findings)
    _print_written(out, written)
    typer.echo(f"campaigns of the grids, for towtank run: {fits}/")


def _ship(name: str) -> Ship:
    """Ship of a TOML file with ``[ship]``, or a named one."""
    from ..core.ship import Ship

    path = Path(name)
    if path.suffix.lower() != ".toml" and not path.exists():
        from ..simulate.ships import named_ship

        return named_ship(name).ship
    from ..formats.checked_toml import read_toml

    data = read_toml(path, ReadError, what="TOML file with [ship]")
    if not isinstance(data.get("ship"), dict):
        raise ReadError("there is no section [ship]", cure="give name, L, B, T, rho there", file=path)
    return Ship.from_dict(data["ship"])


def _choices(
    axes: str,
    density: float | None,
    half_model: bool,
    moment_point: str | None,
    midship: str,
    hull_turned: bool,
    history: str | None,
    columns: list[str] | None,
) -> LoadChoices:
    from ..cfd.case_loads import LoadChoices

    return LoadChoices(
        axes=axes,
        density=density,
        half_model=half_model,
        moment_point=None if moment_point is None else _point(moment_point, "--moment-point"),
        midship=_point(midship, "--midship"),
        hull_turned=hull_turned,
        object=history,
        columns=dict(_column(item) for item in columns or ()),
    )


def _sweep(cases: list[Path], pattern: str | None, table: Path | None, cells: str | None) -> CaseSweep:
    from ..cfd.case_sweep import find_cases

    counts = None if cells is None else dict(_cell_count(item) for item in cells.split(","))
    return find_cases(cases, pattern=pattern, table=table, cells=counts)


def _point(text: str, option: str) -> Point:
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise TowtankError(f"{option} '{text}' is not a point", cure="give three numbers: 3.5,0,0") from None
    return x, y, z


def _column(text: str) -> tuple[str, str]:
    load, equals, name = text.partition("=")
    if not (equals and name.strip()):
        raise TowtankError(f"--column '{text}' is not LOAD=COLUMN", cure="write Fx_total=Drag")
    return load.strip(), name.strip()


def _cell_count(text: str) -> tuple[str, float]:
    grid, _, number = text.partition("=")
    try:
        return grid.strip(), float(number)
    except ValueError:
        raise TowtankError(f"--cells '{text}' is not GRID=NUMBER", cure="write 1=8000000,2=2828000") from None


def _print_json(data: dict[str, Any]) -> None:
    typer.echo(json.dumps(data, indent=1, ensure_ascii=False))


def _print_written(out: Path | None, written: list[Path]) -> None:
    if written:
        typer.echo(f"\n-> {out}/: {', '.join(path.name for path in written)}")
