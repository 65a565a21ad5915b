"""The gallery, computed once for all tests of this room."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from towtank.reproduce import Case, papers

Find = Callable[..., Case]


@pytest.fixture(scope="session")
def shown() -> dict[str, list[Case]]:
    """Cases of every paper by its key."""
    return {key: list(paper.cases()) for key, paper in papers().items()}


@pytest.fixture(scope="session")
def find(shown: dict[str, list[Case]]) -> Find:
    """``find(paper, quantity, case)``: the one case whose texts contain these."""

    def one(paper: str, quantity: str, case: str = "") -> Case:
        found = [item for item in shown[paper] if quantity in item.quantity and case in item.case]
        assert len(found) == 1, f"{len(found)} cases of {paper} have '{quantity}' in '{case}'"
        return found[0]

    return one
