"""The folder of results of scored computations, and what a terminal shows of them."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Any

from ..core.provenance import program_versions
from ..squat.code_scores import SIGNS, CodeScores
from .aligned_text import aligned_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json

SCORE_FORMAT = "towtank scores provenance 1"


def require_score_folder(out: str | Path) -> None:
    """Refuse a place that cannot take scores, before anything is computed.

    Raises
    ------
    TowtankError
        When `out` is a file, or holds results of another kind.
    """
    require_folder(Path(out), SCORE_FORMAT)


def write_scores(
    scores: CodeScores, out: str | Path, *, report: bool = True, progress: Progress | None = None
) -> list[Path]:
    """Write every score of some computations.

    Files are ``scores.csv`` (case, quantity, n, Q, BS, bias, rms, max_abs, unit), ``score_details.csv`` (with further
    scores and the deviations at full scale), ``errors.csv`` (point by point), ``totals.csv``, with several
    computations ``ranking.csv``, with motions ``motions.csv``, ``scores.json``, ``report.html`` and
    ``provenance.json``.

    Parameters
    ----------
    scores : CodeScores
    out : str or Path
        Folder of the results; made when it is missing.
    report : bool
        Write ``report.html``.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    TowtankError
        When `out` is a file, cannot be written to, or holds results of another kind.
    """
    writers: list[tuple[str, Writer]] = [
        ("scores.csv", csv_writer(lambda: scores.scores)),
        ("score_details.csv", csv_writer(lambda: scores.details)),
        ("errors.csv", csv_writer(lambda: scores.points)),
        ("totals.csv", csv_writer(lambda: scores.totals)),
        ("scores.json", lambda path: write_json(scores.to_dict(), path)),
    ]
    if not scores.motions.empty:
        writers.insert(4, ("motions.csv", csv_writer(lambda: scores.motions)))
    if len(scores.codes) > 1:
        writers.insert(4, ("ranking.csv", csv_writer(lambda: scores.ranking)))
    if report:

        def write_page(path: Path) -> None:
            # drawing needs matplotlib, which the command line must not load at its start
            from .score_page import render_scores

            path.write_text(render_scores(scores), encoding="utf-8")

        writers.append(("report.html", write_page))
    return write_folder(Path(out), writers, score_provenance(scores), progress)


def score_provenance(scores: CodeScores, created: datetime | None = None) -> dict[str, Any]:
    """Files, signs, scale, versions, as plain data."""
    return {
        "format": SCORE_FORMAT,
        "created": timestamp(created),
        "versions": program_versions(),
        "signs": SIGNS,
        "by": scores.measured.by,
        "scale": scores.scale,
        "interpolation": "linear at the measured points, no extrapolation",
        "inputs": {one.path: one.sha256 for one in (scores.measured, *scores.codes)},
        "findings": [vars(item) for item in scores.findings],
    }


def score_text(scores: CodeScores) -> str:
    """What a terminal shows: scores by case, totals, ranking, the signs."""
    frame = scores.scores
    columns = [*frame.columns]
    if scores.scale != 1.0:
        for name in ("bias_full_scale", "rms_full_scale", "max_abs_full_scale", "unit_full_scale"):
            head = name.replace("_full_scale", " full")
            frame[head] = scores.details[name]
            columns.append(head)
    frame["note"] = scores.details["note"]
    lines = [
        f"{len(scores.codes)} computation(s) against {Path(scores.measured.path).name}, by {scores.measured.by}",
        "",
        aligned_text(frame, [*columns, "note"]),
    ]
    if len(scores.measured.cases) > 1 or scores.details["quantity"].nunique() > 1:
        lines += [
            "",
            "totals over cases (Q weighted by n):",
            aligned_text(scores.totals, list(scores.totals.columns)),
        ]
    if not scores.motions.empty:
        lines += ["", "motions, amplitude and phase together:"]
        lines.append(aligned_text(scores.motions, list(scores.motions.columns)))
    if len(scores.codes) > 1:
        shown = ["quantity", "rank", "code", "n", "Q", "BS", "bias", "rms", "max_abs", "note"]
        lines += ["", "ranked by rms:", aligned_text(scores.ranking, shown)]
    return "\n".join([*lines, "", SIGNS])
