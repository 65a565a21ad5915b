from __future__ import annotations

import subprocess
import sys

import pytest

from towtank import identify


@pytest.mark.parametrize("name", identify.__all__)
def test_every_public_name_loads(name: str) -> None:
    assert getattr(identify, name).__name__ == name


def test_unknown_names_are_attribute_errors() -> None:
    with pytest.raises(AttributeError, match="no attribute 'fit_magic'"):
        identify.fit_magic  # noqa: B018


def test_importing_the_room_loads_no_heavy_library() -> None:
    code = (
        "import sys; from towtank.identify.steady_window import steady_window;"
        "from towtank.identify import fit_linear, fit_harmonics, mean_with_error;"
        "heavy = {'scipy', 'pandas', 'statsmodels', 'sklearn', 'cvxpy', 'numba'} & set(sys.modules);"
        "sys.exit(','.join(sorted(heavy)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
