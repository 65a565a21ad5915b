"""``towtank reproduce``."""

from __future__ import annotations

import json

KEYS = {"paper", "case", "quantity", "printed", "computed", "tolerance", "verdict", "note"}
VERDICTS = {"reproduced", "reproduced-after-correction", "not-reproducible"}


def test_papers_are_listed_with_their_citations(towtank):
    ended = towtank("reproduce", "--list")
    assert ended.status == 0
    keys = [line.split()[0] for line in ended.out.splitlines()]
    assert {"dtc-pmm", "s175"} <= set(keys)
    assert all(len(line.split()) > 4 for line in ended.out.splitlines())


def test_several_papers_as_json(towtank):
    ended = towtank("reproduce", "s175", "inland", "--json")
    assert (ended.status, ended.err) == (0, "")
    cases = json.loads(ended.out)
    assert [case["paper"] for case in cases] == sorted(
        (case["paper"] for case in cases), key=["s175", "inland"].index
    )
    assert {case["paper"] for case in cases} == {"s175", "inland"}
    assert all(set(case) == KEYS and case["verdict"] in VERDICTS for case in cases)
    assert all(case["note"] for case in cases if case["verdict"] != "reproduced")


def test_a_paper_as_text_counts_its_verdicts(towtank):
    ended = towtank("reproduce", "s175")
    assert ended.status == 0
    assert "reproduced" in ended.out
    assert "printed" in ended.out


def test_an_unknown_paper(towtank):
    ended = towtank("reproduce", "s176")
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert "the gallery has no paper 's176' -> try one of s175" in ended.err
