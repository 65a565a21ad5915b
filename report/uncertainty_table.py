"""Runs of a solver at sampled inputs, from a file: one row a run, columns for inputs and outputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.errors import ReadError
from ..core.provenance import file_hash
from .numbered_rows import cell_number, numbered_rows

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class SampledRuns:
    """Inputs and outputs of finished runs.

    Attributes
    ----------
    file, sha256 : str
    inputs, outputs : DataFrame
        One row a run.
    left_out : tuple of str
        Columns with words, which name the runs.
    """

    file: str
    sha256: str
    inputs: pd.DataFrame
    outputs: pd.DataFrame
    left_out: tuple[str, ...]


def read_sampled_runs(path: str | Path, inputs: Sequence[str], outputs: Sequence[str] = ()) -> SampledRuns:
    """Read a table of runs.

    Parameters
    ----------
    path : str or Path
    inputs : sequence of str
        Columns of the inputs.
    outputs : sequence of str
        Columns of the outputs; when empty, every other column that holds numbers.

    Raises
    ------
    ReadError
        When a column is missing, a cell of an input or a named output is no number, or no output is left.
    """
    import pandas as pd

    path = Path(path)
    table = numbered_rows(path, "one for each input and each output")
    for name in (*inputs, *outputs):
        if name not in table.names:
            raise ReadError(
                f"the table has no column '{name}'", cure=f"it has {', '.join(table.names)}", file=path
            )
    if not table.rows:
        raise ReadError("the table has no rows", cure="give one row for each run", file=path)
    others = [name for name in table.names if name not in inputs]
    words = [name for name in others if not outputs and not any(_is_number(row[name]) for _, row in table.rows)]
    chosen = list(outputs) or [name for name in others if name not in words]
    if not chosen:
        raise ReadError("the table has no column of outputs", cure="add what the runs gave", file=path)

    def columns(names: Sequence[str]) -> pd.DataFrame:
        return pd.DataFrame(
            {
                name: [cell_number(row[name] or "nan", name, path, f"line {number}") for number, row in table.rows]
                for name in names
            }
        )

    return SampledRuns(path.name, file_hash(path), columns(inputs), columns(chosen), tuple(words))


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
