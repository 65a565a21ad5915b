"""Series that take every branch of the least squares."""

from towtank.reproduce.paper_eca_hoekstra import cases

CASES = list(cases())


def test_every_series_and_every_form_is_there():
    assert len({case.case for case in CASES}) == 5
    assert {case.computed for case in CASES if case.quantity.startswith("form")} == {"h^p", "h^2", "h"}
    assert {case.verdict for case in CASES} == {"reproduced"}


def test_scatter_branch_is_reached():
    assert next(case for case in CASES if case.quantity.startswith("sigma exceeds")).computed == "yes"
