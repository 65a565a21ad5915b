"""Names of the room are loaded when they are first used."""

from __future__ import annotations

import subprocess
import sys

import towtank.simulate as simulate


def test_every_name_is_found():
    for name in simulate.__all__:
        assert getattr(simulate, name) is not None, name


def test_functions_stay_in_front_of_their_modules():
    from towtank.simulate.ensemble import ensemble
    from towtank.simulate.indices import indices
    from towtank.simulate.sail import sail

    assert simulate.sail is sail
    assert simulate.indices is indices
    assert simulate.ensemble is ensemble


def test_the_room_is_light():
    code = "import sys, towtank.simulate; print(sorted({'numba', 'pandas', 'scipy', 'numpy'} & set(sys.modules)))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert loaded.strip() == "[]"
