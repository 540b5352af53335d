"""Every effect goes on where the blocks that it acts on have split.

A block in flight, pulled across by an initial stress, splits in its first step along its middle.
The effect has one resultant whatever the pieces do, so that their mean motion is that of a mass
point,
``m y'' = F - c y' - k y``, whose answer is a closed form.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.linalg import expm

import nmm
from nmm.model.effects_table import EFFECTS

DURATION, SPEED, MASS, GRAVITY = 0.02, -1.0, 2000.0, 9.80665

FLIGHT = """
plane = "strain"
duration = 0.02
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000.0
{matter}
[[blocks]]
name = "c"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[initial_velocities]]
block = "c"
velocity = [0, -1]
[[initial_stresses]]
block = "c"
stress = [{pull}, 0, 0]
[inertia]
[contact]
[interfaces.i]
friction_angle = 0.0
[splitting.m]
tensile_strength = 5e4
smallest_block = 0.02
most_blocks = 2
[[monitors]]
name = "left"
point = [0.25, 0.5]
[[monitors]]
name = "right"
point = [0.75, 0.5]
[formulation.integrator]
type = "newmark"
step = 5e-4
"""
TOP = "segment = [[0, 1], [1, 1]]"
GROUND = """
[[{key}]]
name = "left member"
points = [[0.25, 1], [0.25, 3]]
blocks = ["c", "ground"]
{constant}
[[{key}]]
name = "right member"
points = [[0.75, 1], [0.75, 3]]
blocks = ["c", "ground"]
{constant}
"""
SHAKEN = """
[materials.other]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000.0
[records.still]
values = [0, 0]
step = 1.0
[[blocks]]
name = "ground"
material = "other"
vertices = [[5, 0], [6, 0], [6, 1], [5, 1]]
[[supports]]
name = "shaken"
block = "ground"
fix = ["x", "y"]
motion = { x = "still" }
"""
WATER_BESIDE = """
[materials.other]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000.0
[interfaces.wet]
between = ["m", "other"]
friction_angle = 0.0
aperture = 1e-4
[[blocks]]
name = "d"
material = "other"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[initial_velocities]]
block = "d"
velocity = [0, -1]
[[joint_heads]]
name = "above"
point = [1, 1]
head = 5.0
[[joint_heads]]
name = "below"
point = [1, 0]
head = 4.0
"""
DOWELED = """
[[bars]]
name = "across"
points = [[0.25, 0.5], [0.75, 0.5]]
diameter = 0.03
young_modulus = 2e11
[bars.bond]
stiffness = 1e9
[bars.dowel]
bedding_stiffness = 5e7
"""
WARM = "thermal_expansion = 1e-6\nconductivity = 2.0\nheat_capacity = 900.0"
WET = "hydraulic_conductivity = 1e-6\nspecific_storage = 1e-6"
HEADS = """
[[heads]]
name = "above"
segment = [[0, 1], [1, 1]]
head = 5.0
[[heads]]
name = "below"
segment = [[0, 0], [1, 0]]
head = 4.0
"""


@dataclass(frozen=True)
class Acts:
    """What an effect adds to the scene, and to the equation of the mass point, all in SI.

    Heat, dowels and the pressure of water in pores and joints act within: they have no resultant.
    """

    text: str = ""
    force: float = 0.0
    damping: float = 0.0
    stiffness: float = 0.0
    mass: float = 0.0
    matter: str = ""
    pull: float = 1e5
    within: float = 5e-3

    def way(self) -> float:
        """Return the way (m) of the mass point at the end."""
        mass = MASS + self.mass
        a = np.array(
            [
                [0, 1, 0],
                [-self.stiffness / mass, -self.damping / mass, self.force / mass],
                [0, 0, 0],
            ]
        )
        return float((expm(a * DURATION) @ [0.0, SPEED, 1.0])[0])


ACTS = {
    "gravity": Acts("[gravity]", force=-MASS * GRAVITY),
    "loads": Acts(f'[[loads]]\nname = "l"\nkind = "edge"\n{TOP}\ntraction = [0, -4e4]', force=-4e4),
    "body loads": Acts(
        '[[loads]]\nname = "l"\nkind = "body"\nblock = "c"\ndensity = [0, -3e4]', force=-3e4
    ),
    "field loads": Acts(
        f'[[loads]]\nname = "l"\nkind = "edge"\n{TOP}\nfield = ["0", "-6e4*x*(1 - x)"]', force=-1e4
    ),
    "pressures": Acts(
        f'[[loads]]\nname = "l"\nkind = "pressure"\n{TOP}\npressure = 4e4', force=-4e4
    ),
    "moving loads": Acts(
        f'[[loads]]\nname = "l"\nkind = "moving"\n{TOP}\nforce = [0, -4e4]\nspeed = 50', force=-4e4
    ),
    "water pressures": Acts(f'[[water_pressures]]\nname = "w"\n{TOP}\npressure = 5e4', force=-5e4),
    "springs": Acts(GROUND.format(key="springs", constant="stiffness = 1e6"), stiffness=2e6),
    "dashpots": Acts(GROUND.format(key="dashpots", constant="viscosity = 1e4"), damping=2e4),
    "bars": Acts(
        GROUND.format(key="bars", constant="area = 1e-2\nyoung_modulus = 2e8"), stiffness=2e6
    ),
    "foundations": Acts(
        f'[[foundations]]\nname = "f"\n{TOP}\nnormal_stiffness = 2e6', stiffness=2e6
    ),
    "masses": Acts(
        "[gravity]\n"
        + "".join(
            f'[[masses]]\nname = "{side}"\npoint = [{x}, 0.5]\nblock = "c"\nmass = 500.0\n'
            for side, x in (("first", 0.25), ("second", 0.75))
        ),
        force=-(MASS + 1000.0) * GRAVITY,
        mass=1000.0,
    ),
    "viscous boundaries": Acts(
        f'[[viscous_boundaries]]\nname = "v"\n{TOP}\ndensity = 100.0\np_velocity = 200.0\n'
        "s_velocity = 100.0",
        damping=2e4,
    ),
    "viscous damping": Acts("[damping]\nmass = 10.0\nstiffness = 1e-5", damping=10 * MASS),
    "damping against the ground": Acts(
        SHAKEN + '[damping]\nmass = 10.0\nground = "shaken"', damping=10 * MASS
    ),
    "local damping": Acts(
        "[gravity]\n[damping]\nlocal = 0.5", force=-MASS * GRAVITY / 2, within=0.06
    ),
    "dowels": Acts(DOWELED),
    "joint flow": Acts(WATER_BESIDE + "[joint_flow]"),
    "transient joint flow": Acts(WATER_BESIDE + "[joint_flow]\ntransient = true\ninitial = 4.0"),
    "heat": Acts(f'[heat]\n[[temperatures]]\nname = "w"\n{TOP}\ntemperature = 3.0', matter=WARM),
    "seepage": Acts("[seepage]\n" + HEADS, matter=WET),
    "consolidation": Acts(
        "[seepage]\ntransient = true\ncoupled = true\ninitial = 4.0\n" + HEADS,
        matter=WET,
        pull=4e5,
    ),
}


ELSEWHERE = {
    "initial velocity": "in every scene here",
    "initial stress": "in every scene here",
    "inertia": "in every scene here",
    "contact": "in every scene here",
    "splitting": "in every scene here",
    "supports": "in the scene of damping against the ground; tests of growth hold what divides",
    "free fields": "in stages that change the cover under them",
    "bonded interfaces": "in stages whose blocks leave",
    "artificial joints": "refused beside what splits, unless they may part",
    "fracture": "divides blocks itself",
    "fracture in time": "divides blocks itself",
    "cohesive zones": "divides blocks itself",
    "changed materials": "of stages",
    "unreleased forces": "of stages, which no event interrupts",
}
"""Effects that are held to a change of topology by other tests, and where."""


def test_every_effect_is_held_to_a_change_of_topology():
    assert set(ACTS) | set(ELSEWHERE) == set(EFFECTS.table)
    assert not set(ACTS) & set(ELSEWHERE)


@pytest.mark.parametrize("name", ACTS)
def test_the_pieces_of_a_block_move_under_an_effect_as_a_mass_point_does(name):
    acts = ACTS[name]
    text = FLIGHT.format(matter=acts.matter, pull=acts.pull) + acts.text
    found = nmm.run(nmm.parse_scene(text, "scene"))
    assert found.summary.status == "converged", found.summary.sentence
    assert found.summary.changes[0].endswith("1 block splits into 2 (1 by tension)")
    ends = (found.history[f"monitor:{side}:uy"][-1] for side in ("left", "right"))
    alone = SPEED * DURATION
    # Of 40 steps the first begins without acceleration, and springs give way with the block.
    within = acts.within * abs(acts.way() - alone) + 1e-12
    assert sum(ends) / 2 - alone == pytest.approx(acts.way() - alone, abs=within)
