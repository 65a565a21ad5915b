import subprocess
import sys

import pytest

import towtank.squat


@pytest.mark.parametrize("name", towtank.squat.__all__)
def test_name_is_there(name):
    assert getattr(towtank.squat, name).__doc__ or name.isupper()


def test_unknown_name():
    with pytest.raises(AttributeError, match="no attribute 'guess'"):
        _ = towtank.squat.guess


def test_the_room_opens_without_slow_libraries():
    code = (
        "import sys, towtank.squat, towtank.squat.squat_campaign, towtank.squat.prediction;"
        "print({'numba', 'pandas', 'scipy.optimize', 'scipy.signal', 'matplotlib'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "set()"
