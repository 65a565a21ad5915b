"""The report as a page: complete, self-contained, safe and well formed."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from datetime import UTC, datetime
from html.parser import HTMLParser
from pathlib import Path

import pytest

from towtank.core.findings import Finding
from towtank.pmm import CampaignResult
from towtank.report import render_report, write_report

VOID = {"meta", "br", "hr", "img", "link", "input"}
CREATED = datetime(2020, 2, 3, 4, 5, tzinfo=UTC)


class Page(HTMLParser):
    """Tags, identifiers, links and text of a page; unbalanced tags are an error."""

    def __init__(self, source: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: Counter[str] = Counter()
        self.ids: Counter[str] = Counter()
        self.links: list[str] = []
        self.rows: list[tuple[str, list[str]]] = []
        self.text = ""
        self.feed(source)
        self.close()
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.tags[tag] += 1
        if given.get("id"):
            self.ids[str(given["id"])] += 1
        self.links += [str(given[key]) for key in ("href", "src") if given.get(key)]
        if tag == "tr":
            self.rows.append((given.get("class") or "", []))
        if tag in ("td", "th") and self.rows:
            self.rows[-1][1].append("")
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data
        if {"td", "th"} & set(self.open[-4:]) and self.rows and self.rows[-1][1]:
            self.rows[-1][1][-1] += data


@pytest.fixture(scope="module")
def pmm_source(pmm_result: CampaignResult) -> str:
    return render_report(pmm_result, created=CREATED)


@pytest.fixture(scope="module")
def pmm_page(pmm_source: str) -> Page:
    return Page(pmm_source)


def test_every_section_can_be_reached(pmm_page: Page) -> None:
    anchors = {link[1:] for link in pmm_page.links if link.startswith("#")}
    sections = {
        "derivatives", "conventions", "fits", "residuals", "series", "harmonics", "ways", "models", "diagnostics",
        "runs", "findings", "choices", "provenance",
    }  # fmt: skip
    assert sections <= anchors
    assert anchors <= set(pmm_page.ids)
    assert all(pmm_page.ids[section] == 1 for section in sections)


def test_the_page_needs_nothing_beside_itself(pmm_page: Page, pmm_source: str) -> None:
    outside = [link for link in pmm_page.links if not link.startswith("#")]
    assert all(link.startswith("data:image/png;base64,") for link in outside)
    assert pmm_page.tags["script"] == 0
    assert pmm_page.tags["link"] == 0
    assert "url(http" not in pmm_source
    assert "@import" not in pmm_source


def test_figures_are_described(pmm_source: str, pmm_page: Page) -> None:
    assert pmm_page.tags["svg"] >= 20
    assert pmm_source.count('role="img" aria-label="') == pmm_page.tags["svg"]


def test_every_derivative_is_in_the_table(pmm_page: Page, pmm_result: CampaignResult) -> None:
    first_column = [cells[0] for _, cells in pmm_page.rows if cells]
    assert {"R0", "Yvvr", "Nrrr", "Yv̇"} <= set(first_column)
    assert "½ ρ L T U²" in pmm_page.text


def test_virtual_data_are_announced(pmm_source: str, drift_result: CampaignResult) -> None:
    assert "computed, not measured" in pmm_source
    assert "computed, not measured" not in render_report(drift_result)


def test_names_are_escaped_and_empty_sections_left_out(drift_result: CampaignResult) -> None:
    source = render_report(drift_result, created=CREATED)
    page = Page(source)
    assert "DTC &lt;static&gt; drift" in source
    assert "DTC <static> drift" in page.text
    assert not {"series", "harmonics", "models"} & set(page.ids)
    assert "#series" not in page.links


def test_findings_with_their_waivers(drift_result: CampaignResult) -> None:
    findings = (
        Finding("density", "error", "1000 kg/m3 is fresh water", file="a.txt", cure="mend it", accepted=True),
        Finding("gaps", "warning", "3 gaps", file="b.txt"),
    )
    page = Page(render_report(replace(drift_result, findings=findings)))
    rows = {cells[1]: (mark, cells) for mark, cells in page.rows if len(cells) == 5}
    assert rows["density"][1][0] == "error, accepted"
    assert rows["gaps"][0] == "weak"
    assert "1 error (accepted), 1 warning" in page.text


def test_each_group_has_its_tables(depths_result: CampaignResult) -> None:
    page = Page(render_report(depths_result))
    assert page.text.count("h/T 1.5") >= 5
    assert sum(cells[0] == "derivative" for _, cells in page.rows if cells) == 4
    assert "1.5, 2" in page.text  # depths among the particulars


def test_sources_date_and_citation(pmm_page: Page, pmm_result: CampaignResult) -> None:
    assert "2020-02-03 04:05 UTC" in pmm_page.text
    digest = pmm_result.fits[0].derivatives.provenance.inputs["campaign.toml"]
    assert f"campaign file sha256 {digest[:16]}" in pmm_page.text
    assert digest in pmm_page.text


def test_the_same_result_gives_the_same_page(drift_result: CampaignResult) -> None:
    assert render_report(drift_result, created=CREATED) == render_report(drift_result, created=CREATED)


def test_write_report_replaces_the_page_at_the_end(drift_result: CampaignResult, tmp_path: Path) -> None:
    steps: list[tuple[str, int, int]] = []
    path = write_report(drift_result, tmp_path / "r.html", progress=lambda *step: steps.append(step))
    assert path.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert steps == [("drawing", 0, 1), ("drawing", 1, 1)]
    assert [entry.name for entry in tmp_path.iterdir()] == ["r.html"]
