"""Machine code of the kernel: its lowered form in the package, the disk, and the same numbers without either."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

from towtank.simulate import compiled_kernel
from towtank.simulate.compiled_kernel import DIMENSIONS, LOWERED, Lowered, fingerprint, sail_many

_CIRCLE = """
import sys
from towtank.simulate.manoeuvres import turning
from towtank.simulate.sailing import sail_events
from towtank.simulate.ships import named_ship
print(*(float(x).hex() for x in sail_events(named_ship("kvlcc2"), turning(35)).events["heading 90"][0]))
print("numba" in sys.modules)
"""


def circle(folder):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(folder)}
    run = subprocess.run(
        [sys.executable, "-c", _CIRCLE], env=environment, capture_output=True, text=True, check=True
    )
    return run.stdout.splitlines()


def test_lowered_form_in_the_package_is_of_these_sources():
    lowered = Lowered.unpacked(LOWERED.read_bytes())
    assert lowered.sources == fingerprint(), "run python -m towtank.simulate.lowering"
    assert lowered.symbol in lowered.text


def test_code_is_made_and_kept_without_numba(tmp_path):
    first = circle(tmp_path)
    kept = [file.name for file in tmp_path.iterdir()]
    assert len(kept) == 1
    assert kept[0].startswith("kernel-")
    assert circle(tmp_path) == first
    assert [file.name for file in tmp_path.iterdir()] == kept
    assert first[1] == "False"


def test_folder_that_cannot_be_written_to_is_no_obstacle(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    assert circle(blocked)[1] == "False"


def test_lowered_form_of_other_sources_or_another_processor_is_not_used(monkeypatch, tmp_path):
    lowered = Lowered("sources", "symbol", 'target triple = "here"\n')
    path = tmp_path / "kernel.ll.xz"
    monkeypatch.setattr(compiled_kernel, "LOWERED", path)
    assert compiled_kernel._shipped("sources", "here") is None
    path.write_bytes(lowered.packed())
    assert compiled_kernel._shipped("sources", "here") == lowered
    assert compiled_kernel._shipped("others", "here") is None
    assert compiled_kernel._shipped("sources", "elsewhere") is None


def test_every_source_of_a_compiled_function_is_in_the_fingerprint():
    folder = LOWERED.parent
    compiled = {
        path.stem for path in folder.glob("*.py") if "from .compilation import" in path.read_text(encoding="utf-8")
    }
    assert compiled <= set(compiled_kernel.SOURCES)


def test_arrays_that_are_not_contiguous_are_refused():
    arrays = [np.zeros((2,) * dimensions) for dimensions in DIMENSIONS[:14]]
    arrays[3] = np.zeros((4, 4))[:, ::2]
    with pytest.raises(ValueError, match="contiguous"):
        sail_many(*arrays)
