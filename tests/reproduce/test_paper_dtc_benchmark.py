"""Eleven codes, a simulator and the model tests of DTC in shallow water."""

import pytest

from towtank.reproduce.paper_dtc_benchmark import KEY


def test_errors_of_the_mean_sinkage(find):
    reference = {"SlenderFlow": (-0.0110, 0.0209, 0.0583), "RAPID": (-0.0512, 0.0789, 0.2198)}
    for code, (bias, rms, relative) in reference.items():
        assert find(KEY, f"mean error, m, {code}").computed == pytest.approx(bias, abs=6e-5)
        assert find(KEY, f"RMS error, m, {code}").computed == pytest.approx(rms, abs=6e-5)
        assert find(KEY, f"RMS error over RMS sinkage, {code}").computed == pytest.approx(relative, abs=6e-5)


def test_complex_errors_rank_the_codes(find, shown):
    assert find(KEY, "best code in CW1").computed == "NEMOH"
    assert find(KEY, "best code in CW4").computed == "DIFFRAC channel"
    assert find(KEY, "NEMOH", "complex error, CW1").computed == pytest.approx(0.228, abs=5e-4)
    assert find(KEY, "DIFFRAC channel", "complex error, CW4").computed == pytest.approx(0.181, abs=5e-4)
    assert len([case for case in shown[KEY] if case.case.startswith("complex error")]) == 32


def test_a_right_amplitude_hides_a_wrong_motion(find):
    assert find(KEY, "bow amplitude error of SEAWAY Class. Mod.").computed == 0.0
    assert find(KEY, "SEAWAY Class. Mod.", "complex error, CW3").computed == pytest.approx(0.69, abs=5e-3)


def test_two_prints_are_mended(shown):
    mended = {case.quantity: case for case in shown[KEY] if case.verdict == "reproduced-after-correction"}
    assert set(mended) == {"standard deviation of heave, mm", "wave period in s"}
    assert mended["standard deviation of heave, mm"].computed == pytest.approx(0.0354, abs=5e-5)
    assert mended["wave period in s"].computed == pytest.approx(1.66, abs=5e-3)


def test_the_simulated_stern_does_not_follow_the_bow_as_its_equations_say(find, shown):
    (left,) = [case for case in shown[KEY] if case.verdict == "not-reproducible"]
    assert left.quantity == "stern over bow at 16 kn as at 6 kn"
    assert left.printed - left.computed == pytest.approx(0.0174, abs=5e-4)
    assert find(KEY, "stern over bow by the restoring matrix", "C2").computed == pytest.approx(3.64 / 7.81)


def test_walls_of_the_tank(find):
    for test, gamma, drop in (("C1", 1.043, 0.48), ("C2", 1.057, 4.55), ("C3", 1.077, 0.87)):
        assert find(KEY, "Kreitner's gamma", f"walls, {test}").computed == pytest.approx(gamma, abs=5e-4)
        assert find(KEY, "drop of level", f"walls, {test}").computed == pytest.approx(drop, abs=5e-3)


def test_windows_hold_the_set_speed(shown):
    speeds = [case for case in shown[KEY] if case.quantity == "mean speed, m/s"]
    computed = [case.computed for case in speeds]
    assert computed == pytest.approx([0.3260, 0.8726, 0.3268, 0.3262, 0.8726], abs=1e-4)


def test_added_resistance_with_its_uncertainty(find):
    assert find(KEY, "mean, N", "added resistance, 100").computed == pytest.approx(1.20)
    assert find(KEY, "standard uncertainty", "added resistance, 100").computed == pytest.approx(0.028, abs=5e-4)
    assert find(KEY, "measured, N", "added resistance, CW3").computed == pytest.approx(1.49)
