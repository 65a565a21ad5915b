"""Folder of histories that are no loads: an overview, and one table a history with units in its headings."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..cfd.case_loads import CaseLoads, LoadChoices
from .cfd_settling_outputs import READ_FORMAT, read_provenance
from .result_folder import Progress, Writer, csv_writer, write_folder

if TYPE_CHECKING:
    import pandas as pd


def joined_overview(tables: Sequence[pd.DataFrame]) -> pd.DataFrame:
    """Overviews of several cases below each other."""
    import pandas as pd

    return pd.concat(list(tables), ignore_index=True)


def history_files(histories: Sequence[CaseLoads]) -> list[str]:
    """Name of the file of each history: ``<case>-<history>.csv``, numbered where two would be the same."""
    plain = [re.sub(r"[^\w.+-]+", "_", f"{item.name}-{item.history}") for item in histories]
    count = Counter(name.lower() for name in plain)
    return [
        f"{name}.csv" if count[name.lower()] == 1 else f"{name}-{number}.csv"
        for number, name in enumerate(plain, 1)
    ]


def write_histories(
    overview: pd.DataFrame,
    histories: Sequence[CaseLoads],
    choices: LoadChoices,
    out: str | Path,
    *,
    progress: Progress | None = None,
) -> list[Path]:
    """Write ``histories.csv``, one table a history, and ``provenance.json``.

    Parameters
    ----------
    overview : DataFrame
        One row a history; it gets a column with the names of the files.
    histories : sequence of CaseLoads
        In the order of the rows.
    choices : LoadChoices
    out : str or Path
    progress : callable, optional

    Raises
    ------
    TowtankError
        When `out` cannot be written to or holds results of another kind.
    """
    files = history_files(histories)
    writers: list[tuple[str, Writer]] = [("histories.csv", csv_writer(lambda: overview.assign(file=files)))]
    writers += [(file, csv_writer(item.to_frame)) for file, item in zip(files, histories, strict=True)]
    return write_folder(Path(out), writers, read_provenance(READ_FORMAT, histories, choices, ()), progress)
