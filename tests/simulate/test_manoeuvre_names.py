"""Names of manoeuvres."""

import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.manoeuvre_names import KINDS, read_manoeuvre_name


@pytest.mark.parametrize(
    ("name", "kind", "rudder", "heading"),
    [
        ("turning +35", "turning", 35.0, None),
        ("Turning circle -35", "turning", -35.0, None),
        ("turn 20", "turning", 20.0, None),
        ("zigzag -20/20", "zigzag", -20.0, 20.0),
        ("zig-zag 10/2.5", "zigzag", 10.0, 2.5),
        ("Zig zag", "zigzag", None, None),
        ("initial turning +10", "initial turning", 10.0, None),
        ("pull-out +20", "pull-out", 20.0, None),
        ("pullout", "pull-out", None, None),
        ("crash stop", "crash stop", None, None),
        ("reverse spiral", "reverse spiral", None, None),
        ("spiral 25", "spiral", 25.0, None),
        ("Williamson turn +35", "williamson", 35.0, None),
    ],
)
def test_kind_and_angles(name, kind, rudder, heading):
    assert read_manoeuvre_name(name) == (kind, rudder, heading)


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_read_by_its_own_name(kind):
    assert read_manoeuvre_name(kind).kind == kind


@pytest.mark.parametrize("name", ["", "run 7", "towing"])
def test_other_names_are_refused(name):
    with pytest.raises(TowtankError, match="names no known manoeuvre -> begin the name with one of turning"):
        read_manoeuvre_name(name)
