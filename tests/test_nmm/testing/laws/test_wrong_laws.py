"""Interface laws with one fault each are told, by the property that they break."""

import re

import numpy as np
import pytest

from nmm.interfaces.mohr_coulomb import MohrCoulomb
from nmm.interfaces.softening import LinearSoftening
from nmm.testing import check_interface_law

BOND = {"friction_angle": 0.6, "cohesion": 2e6, "tensile_strength": 1e6, "bonded": True}


class Negative(MohrCoulomb):
    def friction(self, history):
        return super().friction(history) - 1.0


class Gossiping(MohrCoulomb):
    def friction(self, history):
        return np.full(len(history["bonded"]), 1e5 * abs(np.mean(history["plastic_slip"])))


class Fragile(MohrCoulomb):
    def overload(self, pull, shear):
        return 1e-6 * np.abs(pull) + np.abs(shear)


class OneSided(MohrCoulomb):
    def overload(self, pull, shear):
        return super().overload(pull, np.maximum(shear, 0))


class Healing(LinearSoftening):
    def evolved(self, history, gap, sliding, stiffness):
        after = super().evolved(history, gap, sliding, stiffness)
        return after | {"damage": np.where(gap < 0, 0.0, after["damage"])}


class Spoiled(LinearSoftening):
    def evolved(self, history, gap, sliding, stiffness):
        after = super().evolved(history, gap, sliding, stiffness)
        history["damage"][:] = after["damage"]
        return after


class Tough(LinearSoftening):
    @property
    def curve(self):
        return np.array([0.0, 2.5]), np.array([1.0, 0.0])


LAWS = {
    "friction -0.316: expected none below zero": Negative,
    "points know of each other": Gossiping,
    "pressure alone overloads": Fragile,
    "sign of shear": OneSided,
    "damage, which grows, fell": Healing,
    "update changed damage it got": Spoiled,
    "over its fracture energy": Tough,
}


@pytest.mark.parametrize("words", LAWS)
def test_a_wrong_interface_law_is_told(words):
    with pytest.raises(AssertionError, match=re.escape(words)):
        check_interface_law(LAWS[words](**BOND, fracture_energy=100.0))
