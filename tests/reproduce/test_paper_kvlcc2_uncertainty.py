"""KVLCC2 with 31 uncertain parameters: an independent calculation is met within the noise of both."""

from towtank.reproduce.paper_kvlcc2_uncertainty import KEY, uncertain_kvlcc2


def test_31_parameters_scatter_by_five_per_cent(shown):
    assert len(shown[KEY]) == 23
    scatter = uncertain_kvlcc2().scatter
    assert len(scatter.names) == 31
    assert abs(scatter.sd / abs(scatter.center) - 0.05).max() < 1e-12


def test_spread_and_quantiles_are_those_of_the_independent_calculation(shown):
    assert all(case.verdict == "reproduced" for case in shown[KEY])


def test_regression_explains_the_variance_and_agrees_with_the_differences(shown):
    table = uncertain_kvlcc2().elasticities
    for index in ("tactical diameter", "overshoot 2"):
        rows = table[table["index"] == index]
        assert 0.97 < rows["share"].sum() < 1.0
        assert (rows["elasticity"] - rows["first_order"]).abs().max() < 0.05
