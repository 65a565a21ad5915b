"""The drawings of the report: which are made of a group, and that none shares its identifiers with another."""

from __future__ import annotations

import re

import pytest

from towtank.pmm import CampaignResult
from towtank.report.report_figures import Draughtsman, Row


@pytest.fixture(scope="module")
def draw(pmm_result: CampaignResult) -> Draughtsman:
    fit = pmm_result.fits[0]
    return Draughtsman(fit, pmm_result.written(fit), "g1")


def test_rows_of_fits(draw: Draughtsman) -> None:
    rows = list(draw.force_fits())
    assert [row.title for row in rows] == [
        "Steady runs against drift angle β",
        "Harmonics of pure sway runs against amplitude",
        "Harmonics of pure yaw runs against amplitude",
    ]
    assert all(len(row.drawings) == 3 for row in rows)
    assert rows[0].key == ()


def test_series_of_the_runs_that_kept_theirs(draw: Draughtsman, pmm_result: CampaignResult) -> None:
    rows = list(draw.series())
    kept = [run.name for run in pmm_result.fits[0].runs if run.series]
    assert len(kept) == 2
    assert [row.title.split(" (")[0] for row in rows] == kept


def test_drawings_do_not_share_identifiers(draw: Draughtsman) -> None:
    rows: list[Row] = [draw.residuals(), draw.agreement()]
    sources = [drawing.svg for row in rows for drawing in row.drawings]
    sources += [draw.forest(None).svg, draw.correlation().svg]
    found = [set(re.findall(r'<clipPath id="([^"]+)"', source)) for source in sources]
    assert all(found)
    assert len(set.union(*found)) == sum(len(one) for one in found)
