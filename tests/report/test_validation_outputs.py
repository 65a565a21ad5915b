"""What a trial against the simulator leaves behind."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError
from towtank.report.validation_outputs import (
    compared_channel,
    compared_tracks,
    require_validation_folder,
    validation_text,
    write_validation,
)
from towtank.simulate.manoeuvres import crash_stop, turning
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
from towtank.simulate.trial_validation import TrialValidation, validate_trial

SHIP = named_ship("kvlcc2")


def trial(programme):
    return replace(sail(SHIP, programme, interval=0.5), events=None, source="trial.csv")


@pytest.fixture(scope="module")
def found() -> TrialValidation:
    return validate_trial(SHIP, trial(turning(35.0)), draws=10, percent=5.0, seed=2)


def test_tables_tracks_figures_and_provenance_are_written(found, tmp_path):
    written = write_validation(found, SHIP, tmp_path / "check")
    names = {path.name for path in written}
    assert {"validation.csv", "channels.csv", "trajectory_measured.csv", "trajectory_simulated.csv"} <= names
    assert {"figure_track.png", "figure_psi.png", "figure_r.png", "figure_u.png", "figure_v.png"} <= names
    table = pd.read_csv(tmp_path / "check" / "validation.csv").set_index("index")
    assert table.loc["advance", "sd"] > 0.0
    assert bool(table.loc["advance", "covered"])
    facts = json.loads((tmp_path / "check" / "provenance.json").read_text(encoding="utf-8"))
    assert facts["trial"]["file"] == "trial.csv"
    assert facts["trial"]["manoeuvre"] == "turning +35"
    assert facts["draws"].startswith("10 draws, seed 2")
    assert facts["draws that failed"] == 0
    assert set(facts["files"]) == names


def test_the_terminal_says_errors_bands_and_how_many_indices_are_inside(found):
    text = validation_text(found, SHIP)
    assert "kvlcc2 against trial.csv, approach at 1.18 m/s" in text
    line = next(line for line in text.splitlines() if line.startswith("tactical diameter"))
    assert line.split()[-1] == "yes"
    known = [one for one in found.indices["covered"] if one is not None]
    assert f"{sum(known)} of {len(known)} indices inside" in text


def test_an_assumption_of_the_simulated_ship_is_told():
    text = validation_text(validate_trial(SHIP, trial(crash_stop())), SHIP)
    assert "doubt: 'kvlcc2': the thrust astern is assumed" in text


def test_figures_show_both_tracks_and_the_band(found):
    tracks = compared_tracks(found)
    assert [text.get_text() for text in tracks.get_legend().get_texts()] == ["simulated", "measured"]
    assert len(tracks.lines) == 2 + len(found.draws["x"])
    heading = compared_channel(found, "psi")
    assert len(heading.collections) == 1
    np.testing.assert_allclose(heading.lines[1].get_ydata(), np.degrees(found.measured["psi"]))
    assert "rudder, measured" in [text.get_text() for text in heading.get_legend().get_texts()]


def test_results_of_another_kind_stay(tmp_path):
    (tmp_path / "provenance.json").write_text('{"format": "towtank manoeuvres 1"}', encoding="utf-8")
    with pytest.raises(TowtankError, match=r"results of another kind \(manoeuvres and validation\)"):
        require_validation_folder(tmp_path)
