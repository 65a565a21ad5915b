"""Two triplets by every method."""

from towtank.reproduce.paper_grid_triplets import cases

CASES = list(cases())


def test_all_numbers_of_both_triplets():
    assert [sum(f"triplet {name}," in case.case for case in CASES) for name in "AB"] == [9, 6]
    assert {case.verdict for case in CASES} == {"reproduced"}
