"""Names of the room are loaded when they are first used."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import towtank.simulate as simulate


def test_every_name_is_found():
    for name in simulate.__all__:
        assert getattr(simulate, name) is not None, name


def test_no_function_hides_a_module():
    modules = {path.stem for path in Path(simulate.__file__).parent.glob("*.py")}
    assert modules.isdisjoint(simulate.__all__)


def test_the_room_is_light():
    code = "import sys, towtank.simulate; print(sorted({'numba', 'pandas', 'scipy', 'numpy'} & set(sys.modules)))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert loaded.strip() == "[]"
