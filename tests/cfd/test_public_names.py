from __future__ import annotations

import pytest

from towtank import cfd


@pytest.mark.parametrize("name", cfd.__all__)
def test_every_public_name_loads(name):
    assert getattr(cfd, name).__name__ == name


def test_unknown_names_are_attribute_errors():
    with pytest.raises(AttributeError, match="no attribute 'mesh'"):
        cfd.mesh  # noqa: B018
