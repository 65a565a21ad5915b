"""From a voyage file to squat."""

import numpy as np
import pytest

from towtank.core.errors import CampaignError, FitError, ReadError
from towtank.squat.virtual_voyage import DRAUGHT, virtual_voyage
from towtank.squat.voyage_reduction import reduce_voyage, voyage_provenance

VOYAGE = virtual_voyage(step=1.0)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    return VOYAGE.write_folder(tmp_path_factory.mktemp("voyage"))


def test_the_truth_is_left(file):
    told = []
    (found,) = reduce_voyage(file, progress=lambda what, done, total: told.append((done, total)))
    assert found.run == "outbound"
    assert abs(np.mean(found.record.midship - VOYAGE.sinkage)) < 3e-3
    np.testing.assert_allclose(found.density, VOYAGE.density, atol=1e-6)
    np.testing.assert_allclose(found.record.speed, VOYAGE.speed, atol=1e-5)
    least = found.summary.set_index("quantity").loc["least clearance"]
    assert least["value"] == pytest.approx(16.0 + 2.5 - 4e-4 * 1500 - DRAUGHT - 0.97 - 1.06, abs=0.3)
    assert told == [(0, 1), (1, 1)]
    record = voyage_provenance(file, [found])
    assert {name.rsplit("/", 1)[-1] for name in record.inputs} == {
        "voyage.toml",
        "voyage.csv",
        "tide.csv",
        "current.csv",
    }
    assert record.choices["outbound"]["steady mean, s"] == 60.0
    assert all(len(digest) == 64 for digest in record.inputs.values())


def changed(file, *pairs):
    text = file.read_text(encoding="utf-8")
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    other = file.with_name("changed.toml")
    other.write_text(text, encoding="utf-8")
    return other


def test_numbers_instead_of_files_and_columns(file):
    other = changed(
        file,
        ('file = "tide.csv"', "level = 2.0\ncorrection = 0.5"),
        ('file = "current.csv"', "along = 0.5"),
        ('column = "rho"', "under_way = 1025.0"),
        ('[bottom]\ncolumn = "depth"', "[bottom]\ncharted_depth = 15.0"),
        ("[draught]", "[accuracy]\npitch = 0.02\n\n[steady]\nwindow = 30\n\n[draught]"),
    )
    (found,) = reduce_voyage(other)
    np.testing.assert_allclose(found.water_depth, 17.5)
    assert np.ptp(found.density) == 0.0
    assert found.choices["steady mean, s"] == 30.0
    assert found.budgets["bow"].contributions["pitch"] == pytest.approx(2.0 * 0.0148, rel=0.01)


def test_without_density_bottom_and_current(file):
    text = file.read_text(encoding="utf-8")
    begin, end = text.index("[density]"), text.index("[[records]]")
    start, stop = text.index("[current]"), text.index("[static]")
    bare = file.with_name("bare.toml")
    bare.write_text(text[:start] + text[stop:begin] + text[end:], encoding="utf-8")
    (found,) = reduce_voyage(bare)
    assert found.clearance is None
    assert not found.density.any()
    np.testing.assert_allclose(found.record.speed, VOYAGE.speed + VOYAGE.current, atol=1e-5)


@pytest.mark.parametrize(
    ("old", "new", "error", "said"),
    [
        (
            'name = "outbound"',
            '[[records]]\nfile = "voyage.csv"',
            CampaignError,
            "two records have the name 'voyage'",
        ),
        ("stop = 400.0", "stop = 900.0", FitError, r"static reference 0 to 900 s: the ship makes \d"),
        ('file = "tide.csv"', 'file = "tides.csv"', ReadError, r"tides\.csv"),
        ('speed = "sog"', 'speed = "stw"', ReadError, "no channel 'stw'"),
    ],
)
def test_what_cannot_be_reduced_is_named(file, old, new, error, said):
    other = changed(file, (old, new))
    with pytest.raises(error, match=said):
        reduce_voyage(other)
