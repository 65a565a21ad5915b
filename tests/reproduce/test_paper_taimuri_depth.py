"""KVLCC2 from deep to shallow water."""

from towtank.reproduce.paper_taimuri_depth import KEY


def test_shallow_column_follows_from_the_deep_one(shown):
    cases = {case.quantity: case for case in shown[KEY] if case.case.startswith("Table 4")}
    assert len(cases) == 16
    assert {name for name, case in cases.items() if case.verdict != "reproduced"} == {"Nr"}
    assert cases["Nr"].verdict == "reproduced-after-correction"


def test_printed_multiplier_of_the_cubic_terms_is_corrected(find):
    case = find(KEY, "fyv")
    assert case.verdict == "reproduced-after-correction"
    assert (case.printed, round(case.computed, 1)) == (3.76, 6.2)
