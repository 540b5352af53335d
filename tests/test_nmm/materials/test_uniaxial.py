"""Laws of one force and one way: returns to the yield value, and energy that is never made."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.interfaces.bond_slip import (
    BOND_LAWS,
    BilinearBond,
    LinearBond,
    ModelCodeBond,
    PlasticBond,
)
from nmm.materials.uniaxial import Uniaxial
from nmm.testing import check_bond_law

LAWS = {
    "hardening": Uniaxial(100.0, (0.0, 10.0), (5.0, 25.0)),
    "softening": Uniaxial(100.0, (0.0, 1.0), (5.0, 0.0)),
    "cable": Uniaxial(100.0, (0.0,), (5.0,), pushes=False),
    "model code": ModelCodeBond(strength=8e6, slips=(1e-3, 3e-3, 8e-3)).uniaxial,
}


def follow(law, ways):
    """Forces, tangents and memory of one point along a path of ways."""
    plastic, flowed, found = np.zeros(1), np.zeros(1), []
    for way in ways:
        one = law.update(law.stiffness * (way - plastic), plastic, flowed)
        plastic, flowed = one.plastic, one.flowed
        found.append((one.force[0], one.tangent[0]))
    return np.array(found)


def test_hardening_follows_its_line_and_unloads_elastically():
    force = follow(LAWS["hardening"], [0.05, 0.15, 0.25, 0.2])[:, 0]
    # Tangent 100 * 2 / 102 beyond 0.05.
    slope = 200 / 102
    assert force == pytest.approx([5.0, 5 + 0.1 * slope, 5 + 0.2 * slope, 0.2 * slope])


def test_a_cable_goes_slack_and_takes_up_where_it_yielded():
    force = follow(LAWS["cable"], [0.15, 0.0, 0.1, 0.12])[:, 0]
    assert force == pytest.approx([5.0, 0.0, 0.0, 2.0])


@pytest.mark.parametrize(
    ("name", "flowed", "limits"),
    [
        ("hardening", 5.0, (-25.0, 25.0)),
        ("softening", 0.6, (-2.0, 2.0)),  # 5 (1 - 0.6)
        ("cable", 0.0, (0.0, 5.0)),
        ("model code", 2e-3, (-8e6, 8e6)),  # on its plateau
    ],
)
def test_limits_are_those_that_are_still_ahead(name, flowed, limits):
    found = LAWS[name].limits(np.array([flowed]))
    assert [float(one[0]) for one in found] == pytest.approx(limits)


def test_a_cable_pushed_together_is_slack_by_that_way():
    cable = LAWS["cable"]
    assert cable.slack(cable.stiffness * np.array([-0.3, 0.0, 0.2])) == pytest.approx([0.3, 0, 0])


@pytest.mark.parametrize("name", LAWS)
def test_tangents_are_the_derivatives_of_forces(name):
    law = LAWS[name]
    scale = 5 * (law.yields[0] / law.stiffness)
    for way in np.linspace(-1, 1, 9) * scale:
        ends = [
            follow(law, [scale / 3, way + nudge])[-1, 0] for nudge in (-1e-6 * scale, 1e-6 * scale)
        ]
        tangent = follow(law, [scale / 3, way])[-1, 1]
        assert (ends[1] - ends[0]) / (2e-6 * scale) == pytest.approx(
            tangent, abs=1e-4 * law.stiffness
        )


@pytest.mark.parametrize("name", LAWS)
def test_no_path_gives_energy_that_was_not_stored(name):
    law, random = LAWS[name], np.random.default_rng(3)
    ways = np.concatenate(
        [[0.0], np.cumsum(random.normal(size=200)) * law.yields[0] / law.stiffness]
    )
    fine = np.interp(np.linspace(0, 200, 20001), np.arange(201), ways)
    force = follow(law, fine)[:, 0]
    work = np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(fine))
    lost = work - law.energy(force[1:])
    # The trapezoid is off by half a step where a cable goes slack.
    assert (np.diff(lost) >= -1e-4 * np.abs(work).max()).all()


def test_bond_laws_pass_through_the_points_of_their_curves():
    for law in (
        PlasticBond(stiffness=1e10, strength=5e6),
        BilinearBond(strength=8e6, slips=(1e-4, 1e-3), residual_strength=1e6),
        ModelCodeBond(strength=10e6, slips=(1e-3, 3e-3, 10e-3), residual_strength=4e6),
    ):
        ways, values = law.curve
        assert follow(law.uniaxial, ways)[:, 0] == pytest.approx(values, rel=1e-9)


def test_the_model_code_bond_is_a_power_of_slip():
    law = ModelCodeBond(strength=10e6, slips=(1e-3, 3e-3, 10e-3)).uniaxial
    for slip in (0.1e-3, 0.35e-3, 0.9e-3):
        # 40 chords over two decades lie below the curve by 2e-4 at most.
        stress = follow(law, [slip])[0, 0]
        assert stress == pytest.approx(10e6 * (slip / 1e-3) ** 0.4, rel=2e-3)


@pytest.mark.parametrize(
    ("kind", "given", "said"),
    [
        (LinearBond, {}, "no stiffness"),
        (PlasticBond, {"stiffness": 1e9}, "no strength"),
        (BilinearBond, {"strength": 1e6, "slips": (1e-3,)}, "1 slips"),
        (BilinearBond, {"strength": 1e6, "slips": (1e-3, 1e-4)}, "larger than the one before"),
    ],
)
def test_a_bond_that_lacks_a_constant_is_refused(kind, given, said):
    with pytest.raises(ValueError, match=said):
        kind(**given)


BONDS = {
    "linear": {"stiffness": 1e9},
    "plastic": {"stiffness": 1e9, "strength": 3e6},
    "bilinear": {"strength": 3e6, "slips": (1e-3, 4e-3), "residual_strength": 1e6},
    "model_code": {"strength": 8e6, "slips": (1e-3, 3e-3, 8e-3), "residual_strength": 3e6},
}


@pytest.mark.parametrize("name", BOND_LAWS.table)
def test_every_bond_law_keeps_what_bond_laws_promise(name):
    check_bond_law(BOND_LAWS.make(name, {}, **BONDS[name]))


class Gains(Uniaxial):
    """It answers a tenth more where slip is taken back."""

    def update(self, trial, plastic, flowed):
        found = super().update(trial, plastic, flowed)
        return replace(found, force=np.where(flowed > 0, 1.1, 1.0) * found.force)


class Restless(BilinearBond):
    @property
    def uniaxial(self):
        return Gains(**vars(super().uniaxial))


class Leaping(PlasticBond):
    @property
    def uniaxial(self):
        law = super().uniaxial
        return replace(law, yields=tuple(1.01 * one for one in law.yields))


@pytest.mark.parametrize(
    ("law", "told"),
    [
        (Restless(**BONDS["bilinear"]), "stress given back"),
        (Leaping(**BONDS["plastic"]), "stress under growing slip"),
    ],
)
def test_a_bond_law_that_breaks_a_promise_is_told_which(law, told):
    with pytest.raises(AssertionError, match=told):
        check_bond_law(law)


def test_what_flow_takes_is_the_area_under_the_yield_values():
    """Against small steps of the law itself, by trapezia: hardening, softening and beyond."""
    law = Uniaxial(1e3, (0.0, 0.2, 0.5), (10.0, 14.0, 2.0))
    way = np.linspace(0, 0.8, 20_001)
    plastic = flowed = force = np.zeros(1)
    lost, taken = [0.0], [0.0]
    for u in way[1:]:
        found = law.update(1e3 * (u - plastic), plastic, flowed)
        lost.append(lost[-1] + float((force + found.force)[0] / 2 * (found.plastic - plastic)[0]))
        force, plastic, flowed = found.force, found.plastic, found.flowed
        taken.append(float(law.taken(flowed)[0]))
    np.testing.assert_allclose(taken, lost, atol=1e-5 * lost[-1])
    assert lost[-1] == pytest.approx(12 * 0.2 + 8 * 0.3 + 2 * (flowed[0] - 0.5), rel=1e-4)
