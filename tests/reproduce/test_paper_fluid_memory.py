"""Radiation memory: closed loop exact at order two, round trip, decay with memory."""

from towtank.reproduce.paper_fluid_memory import KEY


def test_everything_comes_back(shown):
    assert all(case.verdict == "reproduced" for case in shown[KEY])


def test_closed_loop_is_of_order_two_with_both_treatments_of_infinity(shown):
    orders = [case.computed for case in shown[KEY] if case.quantity == "order"]
    assert orders == [2.0, 2.0]


def test_decay_with_everything_free_finds_the_inertia(shown):
    (case,) = [case for case in shown[KEY] if case.case.endswith("all free") and case.quantity == "inertia"]
    assert abs(case.computed / case.printed - 1.0) < 1e-5


def test_round_trip_loses_less_than_a_thousandth(find):
    assert find(KEY, "largest error of B").computed < 1e-3
    assert find(KEY, "largest error of K(t)").computed < 1e-3
