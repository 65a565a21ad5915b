"""Exports by target."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import TowtankError
from towtank.datasets import load_set
from towtank.report import export_set


def test_csv_holds_every_digit(hull: DerivativeSet, tmp_path: Path) -> None:
    text = export_set(hull, "csv", tmp_path / "set.csv")
    assert (tmp_path / "set.csv").read_text(encoding="utf-8") == text
    frame = pd.read_csv(io.StringIO(text))
    assert list(frame.columns) == ["name", "value", "std", "lower95", "upper95", "scaling"]
    np.testing.assert_array_equal(frame["value"], hull.values)


def test_json_and_latex(hull: DerivativeSet) -> None:
    assert DerivativeSet.from_json(export_set(hull, "json")).to_dict() == hull.to_dict()
    assert "\\begin{tabular}" in export_set(hull, "latex")


def test_a_workbook_needs_a_file(hull: DerivativeSet, tmp_path: Path) -> None:
    with pytest.raises(TowtankError, match="cannot be printed"):
        export_set(hull, "xlsx")
    with pytest.raises(TowtankError, match=r"needs the ending \.xlsx"):
        export_set(hull, "xlsx", tmp_path / "set.ods")
    assert export_set(hull, "xlsx", tmp_path / "set.xlsx") == str(tmp_path / "set.xlsx")
    sheets = pd.read_excel(tmp_path / "set.xlsx", sheet_name=None, engine="openpyxl")
    assert list(sheets) == ["derivatives", "covariance", "conventions"]
    assert sheets["derivatives"]["name"].tolist() == list(hull.names)


def test_unknown_targets_and_terms_without_a_place_leave_no_file(hull: DerivativeSet, tmp_path: Path) -> None:
    with pytest.raises(TowtankError, match="'fortran' is not an export -> use one of csv, json"):
        export_set(hull, "fortran", tmp_path / "x")
    with pytest.raises(TowtankError, match="'Xvphi' has no place"):
        export_set(load_set("pcc-deep"), "shipmmg", tmp_path / "x")
    assert list(tmp_path.iterdir()) == []
