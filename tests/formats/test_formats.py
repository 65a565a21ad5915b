import subprocess
import sys

import pytest

import towtank.formats


def test_public_names_can_be_had():
    for name in towtank.formats.__all__:
        assert getattr(towtank.formats, name) is not None
    assert set(towtank.formats.__all__) <= set(dir(towtank.formats))


def test_unknown_name():
    with pytest.raises(AttributeError, match="has no attribute 'read_word'"):
        towtank.formats.read_word  # noqa: B018


def test_import_is_light():
    heavy = ("pint", "h5py", "nptdms", "python_calamine", "scipy", "pyarrow", "pydantic")
    code = f"import sys, towtank.formats; assert not set({heavy!r}) & set(sys.modules), sorted(sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
