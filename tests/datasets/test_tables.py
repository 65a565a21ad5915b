"""Published tables load, hold what is printed, and agree with each other."""

import math

import numpy as np
import pytest

from towtank.core import Conventions
from towtank.core.errors import DatasetError
from towtank.datasets import catalogue, list_tables, load_set, load_table
from towtank.datasets.catalogue import index

KEYS = list(index("table"))


@pytest.mark.parametrize("key", KEYS)
def test_every_table_loads_with_units_and_source(key):
    table = load_table(key)
    assert list(table.frame.columns) == list(table.units)
    assert len(table.frame) > 0
    assert table.source.split(", ")[0]
    assert table.frame.attrs["units"] == table.units
    assert not table.frame.isna().all(axis=0).any()


def test_list_has_a_line_for_each():
    frame = list_tables()
    assert frame["key"].tolist() == KEYS
    computed = set(frame[frame["computed"]]["key"])
    assert {"inland-forward-values", "kcs-waves-effect"} <= computed
    assert {key for key in computed if key.endswith("-computed")} == {
        key for key in KEYS if key.endswith("-computed")
    }


def test_unknown_table_names_the_nearest():
    with pytest.raises(DatasetError, match="dtc-drift-points"):
        load_table("dtc-drift-point")


def test_static_drift_points_of_dtc():
    table = load_table("dtc-drift-points-63")
    np.testing.assert_allclose(table.frame["v"], -np.sin(np.radians(table.frame["beta"])), atol=6e-4)
    assert table.conventions == Conventions()
    assert table.ship is not None
    assert table.ship.to_dict()["L"] == pytest.approx(5.577, abs=1e-3)
    assert table.frame.loc[4, "Y_EFD"] == 0.108948
    assert table.misprints == ()


@pytest.mark.parametrize("column", ["EFD", "CFD"])
def test_drift_set_of_dtc_is_the_cubic_through_its_points(column):
    # The printed derivatives follow from the printed points: 1 %, for X 2 %.
    frame = load_table("dtc-drift-points-63").frame
    printed = load_set("dtc-drift-efd" if column == "EFD" else "dtc-drift-cfd-63")
    v = frame["v"].to_numpy()
    lateral = np.column_stack([v, v**3])
    for force in ("Y", "N"):
        linear, cubic = np.linalg.lstsq(lateral, frame[f"{force}_{column}"].to_numpy(), rcond=None)[0]
        assert linear == pytest.approx(printed[f"{force}v"], rel=0.01)
        assert cubic == pytest.approx(printed[f"{force}vvv"], rel=0.01)
    surge = np.column_stack([-np.ones_like(v), v**2, v**4])
    fitted = np.linalg.lstsq(surge, frame[f"X_{column}"].to_numpy(), rcond=None)[0]
    np.testing.assert_allclose(fitted, [printed["R0"], printed["Xvv"], printed["Xvvvv"]], rtol=0.02)


def test_yaw_set_of_dtc_follows_from_the_printed_harmonics():
    frame = load_table("dtc-yaw-harmonics").frame.set_index("harmonic")
    yaw = load_set("dtc-yaw-cfd")
    assert 4 / 3 * frame.loc["Y_S1", "rrr"] == pytest.approx(yaw["Yrrr"], abs=1e-4)
    assert 4 / 3 * frame.loc["N_S1", "rrr"] == pytest.approx(yaw["Nrrr"], abs=1e-4)
    assert 2 * frame.loc["X_0", "rr"] == pytest.approx(yaw["Xrr"], abs=1.1e-4)
    assert frame.loc["N_S1", "r"] == yaw["Nr"]


def test_motions_of_the_dtc_programme_are_consistent():
    frame = load_table("dtc-pmm-programme").frame
    np.testing.assert_allclose(frame["r_max"], frame["y_max"] * frame["frequency"] ** 2, atol=1e-9)
    half = (frame["psi_max"] - frame["psi_min"]) / 2
    np.testing.assert_allclose(half, np.degrees(np.arctan(frame["y_max"] * frame["frequency"])), atol=0.006)


def test_grid_convergence_of_dtmb5512_in_eight_of_nine_columns():
    drift = load_table("dtmb5512-drift-grids").frame
    columns = {f"drift_{force}": drift[force].to_numpy() for force in "XYN"}
    pmm = load_table("dtmb5512-pmm-grids").frame
    columns |= {name: pmm[name].to_numpy() for name in pmm.columns if name != "grid"}
    printed = load_table("dtmb5512-grid-convergence").frame.set_index("quantity")
    wrong = []
    for name, (coarse, medium, fine) in columns.items():
        ratio = (fine - medium) / (medium - coarse)
        order = -math.log(ratio) / math.log(1.4)
        index_fine = 1.25 * abs(fine - medium) / (1.4**order - 1)
        found = [ratio, order, index_fine]
        if not np.allclose(found, printed.loc[name, ["R", "p", "GCI_fine"]], atol=6e-6):
            wrong.append(name)
    assert wrong == ["sway_X"]


def test_programmes_of_dtmb5512():
    drift = load_table("dtmb5512-drift-programme").frame
    assert drift.groupby("froude_number").size().tolist() == [9, 9, 7]
    motions = load_table("dtmb5512-pmm-programme")
    assert motions.ship is not None
    r_prime = motions.frame["r_max"].dropna() * motions.ship.L / 1.531
    np.testing.assert_allclose(r_prime, [0.0498, 0.149, 0.299, 0.448, 0.597, 0.747], rtol=3e-3)


def test_pure_sway_run_reaches_ten_degrees():
    run = load_table("dtmb5512-sway-run").frame.iloc[0]
    v_max = run["amplitude"] * 2 * math.pi / run["period"]
    assert math.degrees(math.atan(v_max / run["speed"])) == pytest.approx(run["beta_max"], abs=0.05)


def test_turning_errors_of_the_s175():
    frame = load_table("s175-turning").frame
    recomputed = 100 * (frame["simulated"] - frame["measured"]) / frame["measured"]
    np.testing.assert_allclose(recomputed, frame["error"], atol=0.05)


def test_effect_of_waves_on_kcs():
    coefficients = load_table("kcs-waves-coefficients").frame.set_index("set")
    effect = load_table("kcs-waves-effect").frame.set_index("set")
    for name in ("Yv", "Nv"):
        change = 100 * (coefficients[name] / coefficients.loc["kcs-waves-calm", name] - 1)
        np.testing.assert_allclose(change, effect[f"{name}_change"], atol=0.051)
    np.testing.assert_allclose(coefficients["Nv"] / coefficients["Yv"], effect["lever"], atol=5.1e-4)
    for key, row in coefficients.iterrows():
        assert load_set(str(key)).values.tolist() == [row["Yv"], row["Nv"]]


def test_grid_ratios_of_kcs_and_the_one_that_does_not_follow():
    grids = load_table("kcs-depth-grids").frame
    printed = load_table("kcs-depth-grid-ratios")
    ratios = {}
    for force in "XYN":
        coarse, medium, fine = grids[force]
        ratios[force] = (fine - medium) / (medium - coarse)
    frame = printed.frame.set_index("quantity")["R_G"]
    assert ratios["Y"] == pytest.approx(frame["Y"], rel=0.04)
    assert ratios["N"] == pytest.approx(frame["N"], rel=0.04)
    assert ratios["X"] == pytest.approx(-0.0357, abs=1e-4)
    assert frame["X"] == -0.2778
    assert printed.misprints[0].startswith("R_G of quantity X: -0.2778 as printed is doubtful, -0.0357 is likely")


def test_printed_percentages_of_the_kcs_turn_are_told_as_doubtful():
    table = load_table("kcs-depth-turning")
    frame = table.frame.set_index("quantity")
    error = 100 * (1 - frame["simulated"] / frame["measured"])
    assert error["tactical diameter"] == pytest.approx(4.61, abs=0.005)
    assert error["advance"] == pytest.approx(3.37, abs=0.005)
    assert error["steady turning radius"] == pytest.approx(2.55, abs=0.005)
    assert len(table.misprints) == 2


def test_particulars_of_kcs_scale():
    frame = load_table("kcs-depth-particulars").frame.set_index("item")
    power = {"volume": 3, "wetted surface": 2, "Cb": 0, "Cm": 0}
    for item, row in frame.iterrows():
        assert row["model"] == pytest.approx(row["ship"] / 75.5 ** power.get(str(item), 1), rel=5e-4)


def test_bank_geometry():
    frame = load_table("pcc-bank-geometry").frame
    np.testing.assert_allclose(frame["eta"] + frame["s"], 900 - 358 / 2, atol=1.1)
    np.testing.assert_allclose(frame["eta"] / 2000, frame["eta_over_L"], atol=5e-3)


def test_forward_values_of_the_inland_ship():
    table = load_table("inland-forward-values")
    assert table.computed
    for row in table.frame.itertuples():
        polynomial = load_set(row.set)
        state = {"beta": math.radians(row.beta), "r": row.r}
        for component, expected in (("Y", row.Y), ("N", row.N)):
            force = sum(
                value * float(term.column(state))
                for term, value in zip(polynomial.terms, polynomial.values, strict=True)
                if term.component == component
            )
            assert force == pytest.approx(expected, abs=6e-6)


def test_grid_and_time_step_rows_of_dtc_in_waves():
    frame = load_table("dtc-waves-convergence").frame
    ratio = (frame["S2"] - frame["S1"]) / (frame["S3"] - frame["S2"])
    assert (np.sign(ratio) == np.sign(frame["R"])).all()
    assert ((ratio > 0) == (frame["convergence"] == "monotonic")).all()
    # the time study runs on the medium grid: its finest value is the medium value of the grid study
    for grid, time in (("grid calm", "time calm"), ("grid waves", "time waves")):
        medium = frame[frame["study"] == grid].set_index("quantity")["S2"]
        finest = frame[frame["study"] == time].set_index("quantity")["S1"]
        np.testing.assert_allclose(finest, medium[finest.index], rtol=4e-4)


def test_corrections_are_made_or_told():
    right, printed = load_table("baw-dtc-squat"), load_table("baw-dtc-squat", corrected=False)
    assert right.frame.loc[2, "EFD"] == 0.0050
    assert printed.frame.loc[2, "EFD"] == 0.0045
    assert "0.005 used for the printed 0.0045" in right.misprints[0]
    assert "0.0045 as printed, 0.005 is right" in printed.misprints[0]


def test_empty_cells_are_nan_and_words_stay_words():
    table = load_table("dtc-turning")
    assert math.isnan(table.frame.loc[1, "yaw_rate"])
    assert table.frame["source"].tolist() == ["simulation", "Lyster and Knights 1979"]
    assert load_table("pcc-programme").frame.loc[0, "phi"] == "0;5;10"


BLOCK = '[source]\ntitle = "a"\n[[table]]\nkey = "t"\ntitle = "b"\nplace = "c"\n'


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('units = { a = "-" }\ndata = "a,b\\n1,2"', "columns a, b but units of a"),
        ('units = { a = "-" }\ndata = "a\\nx"', "column 'a' is not of numbers"),
        ('data = "a\\n1"', "'units' is missing"),
        (
            'units = { a = "-" }\ndata = "a\\n1"\n[[table.suspect]]\nwhere = { a = 2 }\ncolumn = "a"\nreason = ""',
            "0 rows have a 2",
        ),
    ],
)
def test_malformed_tables_are_refused(tmp_path, monkeypatch, text, said):
    (tmp_path / "paper.toml").write_text(BLOCK + text)
    monkeypatch.setattr(catalogue, "FOLDER", tmp_path)
    catalogue.index.cache_clear()
    try:
        with pytest.raises(DatasetError, match=said):
            load_table("t")
    finally:
        catalogue.index.cache_clear()
