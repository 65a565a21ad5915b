"""Packing: draws, names, what is missing."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import SimulationError, TermError
from towtank.simulate.manoeuvres import turning
from towtank.simulate.packing import pack
from towtank.simulate.parameters import Parameter
from towtank.simulate.sailing import sail_events
from towtank.simulate.ships import named_ship

KVLCC2 = named_ship("kvlcc2")


def test_each_draw_has_its_own_row():
    changes = {"rudder.eps": np.array([1.0, 1.1]), "propeller.wP0": np.array([0.40, 0.35])}
    packed = pack(KVLCC2, changes=changes)
    assert packed.parameters[:, Parameter.EPS].tolist() == [1.0, 1.1]
    assert packed.parameters[:, Parameter.WP0].tolist() == [0.40, 0.35]
    assert packed.parameters[0, Parameter.KAPPA] == packed.parameters[1, Parameter.KAPPA] == 0.5


def test_a_draw_sails_like_a_vessel_with_its_numbers():
    from dataclasses import replace

    eps = np.array([1.0, 1.1])
    drawn = sail_events(KVLCC2, turning(35), changes={"rudder.eps": eps}).events
    for number, value in enumerate(eps):
        alone = sail_events(KVLCC2.but(rudder=replace(KVLCC2.rudder, eps=value)), turning(35)).events
        assert np.array_equal(drawn["heading 180"][number], alone["heading 180"][0])


def test_coefficients_of_the_open_water_diagram_can_be_drawn():
    from dataclasses import replace

    assert {"propeller.k0", "propeller.k1", "propeller.k2"} <= set(KVLCC2.parameter_names())
    k0 = np.array([0.2931, 0.30])
    drawn = sail_events(KVLCC2, turning(35), changes={"propeller.k0": k0})
    for number, value in enumerate(k0):
        propeller = replace(KVLCC2.propeller, KT=(value, *KVLCC2.propeller.KT[1:]))
        alone = sail_events(KVLCC2.but(propeller=propeller), turning(35))
        assert drawn.rates[number] == alone.rates[0]
        assert np.array_equal(drawn.events["heading 180"][number], alone.events["heading 180"][0])


def test_unknown_number_is_named():
    with pytest.raises(SimulationError, match=r"rudder\.epsilon.*rudder\.eps"):
        pack(KVLCC2, changes={"rudder.epsilon": np.ones(2)})


def test_set_without_added_mass_is_an_error():
    names = [name for name in KVLCC2.hull.names if name != "Yvdot"]
    with pytest.raises(SimulationError, match="has no Yvdot"):
        pack(KVLCC2.with_hull(KVLCC2.hull.subset(names)))


def test_roll_terms_without_roll_moment_are_an_error():
    with pytest.raises(SimulationError, match="phi but no roll moment"):
        pack(KVLCC2.with_hull(KVLCC2.hull.with_values(Yphi=0.01)))


def test_term_that_mixes_accelerations_is_an_error():
    with pytest.raises(TermError, match="vdot"):
        pack(KVLCC2.with_hull(KVLCC2.hull.with_values(Yvvdot=0.01)))


def test_wrong_number_of_derivatives_is_an_error():
    with pytest.raises(SimulationError, match=r"shape \(draws, terms\)"):
        pack(KVLCC2, np.zeros((3, 4)))
