import subprocess
import sys

import pytest

import towtank.decay


@pytest.mark.parametrize("name", towtank.decay.__all__)
def test_name_is_there(name):
    assert getattr(towtank.decay, name).__doc__ or name.isupper()


def test_unknown_name():
    with pytest.raises(AttributeError, match="no attribute 'guess'"):
        _ = towtank.decay.guess


def test_the_room_opens_without_slow_libraries():
    code = (
        "import sys, towtank.decay, towtank.decay.decay_input, towtank.decay.compare;"
        "print({'numba', 'pandas', 'scipy.optimize', 'scipy.signal', 'matplotlib'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "set()"
