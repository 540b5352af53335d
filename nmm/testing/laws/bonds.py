"""What every law of the bond along a bar is held to."""

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.bond_slip import BondLaw
from nmm.materials.uniaxial import Uniaxial, UniaxialAnswer
from nmm.testing.claims import claim, close, finite

# Shares of the strength: rounding of a return, and of a derivative by differences.
EXACT, BY_DIFFERENCES = 1e-9, 1e-5


def check_bond_law(law: BondLaw, seed: int = 0, steps: int = 200) -> None:
    """Hold a bond law to what every one promises.

    Its curve begins without slip and stress and has no stress below zero; under growing slip, to
    either side alike, the law follows it; slip that is taken back goes with the first stiffness;
    tangents are derivatives; and no path of ``steps`` random slips gives energy that was not
    stored.

    Raises
    ------
    AssertionError
        Saying what is not kept and by how much.
    """
    ways, values = law.curve
    claim(len(ways) == len(values) >= 2, f"curve: {len(ways)} slips, {len(values)} stresses")
    finite("curve", np.stack([ways, values]))
    claim(ways[0] == 0 and values[0] == 0, "curve: it does not begin without slip and stress")
    claim(bool((values >= 0).all()), "curve: a stress below zero")
    bond, unit = law.uniaxial, float(values.max())
    # Beyond its last point a curve stays, but for one that never yields.
    slips = np.linspace(0.0, (1.0 if bond.elastic else 1.2) * ways[-1], 101)
    grown = _answer(bond, slips)
    close("stress under growing slip", grown.force, np.interp(slips, ways, values), EXACT * unit)
    close("stress under slip to the other side", _answer(bond, -slips).force, -grown.force, 0.0)
    back = 1e-3 * values[1] / bond.stiffness
    eased = bond.update(grown.force - bond.stiffness * back, grown.plastic, grown.flowed)
    some = grown.force > bond.stiffness * back  # what is spent has nothing to give back
    given = (grown.force - eased.force)[some]
    close("stress given back", given, bond.stiffness * back, EXACT * unit)
    _tangents(bond, slips, unit)
    _energy(bond, np.random.default_rng(seed).normal(size=steps) * ways[1], unit)


def _answer(bond: Uniaxial, slips: Floats) -> UniaxialAnswer:
    """Answer to slips (m,) of points that have not slid before."""
    zero = np.zeros_like(slips)
    return bond.update(bond.stiffness * slips, zero, zero)


def _tangents(bond: Uniaxial, slips: Floats, unit: float) -> None:
    """Claim that tangents are derivatives, but at the corners of the curve."""
    nudge = 1e-7 * slips[-1]
    ends = [_answer(bond, slips[1:] + side * nudge) for side in (-1, 1)]
    smooth = ends[0].tangent == ends[1].tangent
    found = (ends[1].force - ends[0].force)[smooth] / (2 * nudge)
    close("tangent", ends[0].tangent[smooth], found, BY_DIFFERENCES * unit / slips[1])


def _energy(bond: Uniaxial, steps: Floats, unit: float) -> None:
    """Claim that what is stored never exceeds the work done so far."""
    plastic, flowed, slip, force, work = np.zeros(1), np.zeros(1), 0.0, 0.0, 0.0
    for way in np.repeat(steps / 20, 20):  # one point's history, which each step goes on from
        slip += way
        found = bond.update(bond.stiffness * (slip - plastic), plastic, flowed)
        plastic, flowed = found.plastic, found.flowed
        work += way * (force + found.force[0]) / 2
        force = found.force[0]
        made = float(bond.energy(found.force)[0]) - work
        size = unit * float(np.abs(steps).sum())
        claim(made <= 1e-6 * size, f"energy: {made:.3g} J/m2 more stored than work was done")
