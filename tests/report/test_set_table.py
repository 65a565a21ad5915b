"""Sets from tables: what they must say, and what happens when they do not."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ConventionError, ReadError, TowtankError
from towtank.core.ship import Ship
from towtank.report import read_set
from towtank.report.set_table import ShipNotGiven

HEAD = """# name = KVLCC2 of a paper
# source = Table 3
# ship.name = KVLCC2 model
# ship.L = 7.0
# ship.B = 1.27
# ship.T = 0.455
# force_scaling = LT
# added_mass_coriolis = inside
# reference_speed = 1.18
# just a remark
"""
TABLE = "name,value,std\nYv,-0.315,0.01\nNv,-0.137,0.002\n"


def written(folder: Path, text: str, name: str = "set.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_table_with_its_heading(tmp_path: Path) -> None:
    derivatives = read_set(written(tmp_path, HEAD + TABLE))
    assert derivatives.name == "KVLCC2 of a paper"
    assert derivatives.ship.L == 7.0
    assert derivatives.conventions.added_mass_coriolis == "inside"
    assert derivatives.reference_speed == 1.18
    assert derivatives.provenance.source == "Table 3"
    assert len(derivatives.provenance.inputs["set.csv"]) == 64
    np.testing.assert_allclose(derivatives.bse, [0.01, 0.002], rtol=1e-15)
    assert derivatives.to("prime")["Yv"] == pytest.approx(-0.315 * 0.455 / 7.0, rel=1e-14)


def test_a_missing_uncertainty_leaves_the_set_without_covariance(tmp_path: Path) -> None:
    derivatives = read_set(written(tmp_path, HEAD + "name;value;std\nYv;-0.315;0.01\nNv;-0.137;\n"))
    assert derivatives.covariance is None
    assert derivatives["Nv"] == -0.137


def test_a_table_without_ship_has_values_but_no_particulars(tmp_path: Path) -> None:
    path = written(tmp_path, "name,value,scaling\nYv,-0.0205,L2\n")
    derivatives = read_set(path)
    assert isinstance(derivatives.ship, ShipNotGiven)
    assert derivatives.conventions.force_scaling == "L2"
    with pytest.raises(ConventionError, match=r"ship\.L = 7\.0"):
        derivatives.to("lt")
    with pytest.raises(ConventionError, match=r"set\.csv"):
        derivatives.to_json()
    given = Ship("model", L=7.0, B=1.27, T=0.455)
    assert read_set(path, ship=given).to("lt")["Yv"] == pytest.approx(-0.0205 * 7.0 / 0.455, rel=1e-14)


def test_the_unknown_ship_has_every_other_field() -> None:
    ship = ShipNotGiven("x.csv")
    for item in dataclasses.fields(Ship):
        if item.name not in ("L", "B", "T"):
            getattr(ship, item.name)
    with pytest.raises(AttributeError):
        ship.colour  # noqa: B018


def test_the_json_beside_a_table_gives_ship_and_conventions(hull: DerivativeSet, tmp_path: Path) -> None:
    hull.to_json(tmp_path / "derivatives.json")
    hull.to_csv(tmp_path / "derivatives.csv")
    again = read_set(tmp_path / "derivatives.csv")
    assert again.ship == hull.ship
    assert again.conventions == hull.conventions
    assert again.names == hull.names


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name,value\nYv,-0.3\n", "does not say how its values are scaled"),
        ("name,value,scaling\nYv,1,LT\nNv,1,L2\n", "does not say how its values are scaled"),
        ("# force_scaling = LT\nname,value,scaling\nYv,1,L2\n", "says scaling L2, its heading LT"),
        ("# force_scalling = LT\nname,value\nYv,1\n", "line 1: unknown key 'force_scalling'"),
        ("# force_scaling = XL\nname,value\nYv,1\n", "'XL' is not a choice"),
        ("# force_scaling = LT\nname,value\nYv,-0.3o\n", "line 3: value = '-0.3o' is not a number"),
        ("# force_scaling = LT\nname,value\nYv,nan\n", "the value of 'Yv' is missing"),
        ("# force_scaling = LT\nname,value\nYv,1\nYv,2\n", "line 4: 'Yv' is given twice"),
        ("# force_scaling = LT\nname,value\nYv,1,2\n", "3 cells for 2 columns"),
        ("# force_scaling = LT\nname,worth\nYv,1\n", "has the columns name, worth"),
        ("# force_scaling = LT\nname,value\nQv,1\n", "'Qv' is not a term"),
        ("# force_scaling = LT\n# ship.L = 7\nname,value\nYv,1\n", "ship: 'name' is missing|'B' is missing"),
        ("# force_scaling = LT\n# ship.L = seven\nname,value\nYv,1\n", r"ship\.L = 'seven' is not a number"),
        ("# force_scaling = LT\n# reference_speed = fast\nname,value\nYv,1\n", "reference_speed = fast"),
        ("# only remarks\n", "the table is empty"),
    ],
)
def test_faults_are_named(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(TowtankError, match=message) as caught:
        read_set(written(tmp_path, text))
    assert "set.csv" in str(caught.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="file not found"):
        read_set(tmp_path / "none.csv")
    with pytest.raises(ReadError, match="file not found"):
        read_set(tmp_path / "none.json")
    (tmp_path / "latin.csv").write_bytes(b"name,value\n\xe9,1\n")
    with pytest.raises(ReadError, match="not readable as text"):
        read_set(tmp_path / "latin.csv")
