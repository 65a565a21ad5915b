"""DTC: Table 14 with the corrected rudder area, and the printed area out of reach."""

from towtank.reproduce.paper_dtc_pmm import KEY


def test_table_14_with_the_corrected_area(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("Table 14") and case.tolerance]
    assert len(cases) == 6
    assert all(case.verdict == "reproduced" for case in cases)


def test_the_printed_area_is_out_of_reach(shown):
    cases = [case for case in shown[KEY] if "printed rudder area" in case.quantity]
    assert len(cases) == 4
    assert {case.computed for case in cases} == {"out of reach"}


def test_independent_runs_of_four_variants(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("independent")]
    assert len(cases) == 4 * 6
    assert all(case.verdict == "reproduced" for case in cases)
