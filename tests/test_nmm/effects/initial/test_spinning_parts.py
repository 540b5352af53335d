"""A bar that spins and comes in two: by hand, as rigid halves whose strain counts for nothing."""

import numpy as np
import pytest

import nmm

LENGTH, DEPTH, DENSITY, SPIN, STRENGTH = 2.0, 0.2, 1000.0, 18.0, 1e5
INERTIA = DENSITY * LENGTH * DEPTH * (LENGTH**2 + DEPTH**2) / 12
# Half of what spins the bar about its middle: each half flies off with this.
FLIES = SPIN * LENGTH / 4
BAR = """
plane = "stress"
duration = {duration}
[inertia]
[contact]
[materials.m]
young_modulus = 1e8
poisson_ratio = 0.0
density = {density}
[interfaces.joint]
friction_angle = "30 deg"
{bond}
{parts}
[formulation.integrator]
step = 1e-3
[formulation.cover]
{cover}
"""
BOND = f"bonded = true\ntensile_strength = {STRENGTH}\ncohesion = 1e6"
WHOLE = """
[[blocks]]
name = "bar"
material = "m"
vertices = [[-1, -0.1], [1, -0.1], [1, 0.1], [-1, 0.1]]
[[cracks]]
name = "c"
points = [[{at}, -0.2], [{at}, 0.2]]
{bonded}
[[initial_velocities]]
block = "bar"
angular_velocity = {spin}
"""
NET = 'type = "triangles"\nsize = 0.15\ndegree = 0'


def run(duration: float, parts: str, bond: str, cover: str) -> nmm.Run:
    """Return the run of a bar made of such parts."""
    given = {"duration": duration, "density": DENSITY, "bond": bond, "cover": cover}
    return nmm.run(nmm.parse_scene(BAR.format(parts=parts, **given)))


@pytest.mark.parametrize("bonded", [True, False])
@pytest.mark.parametrize("at", [0.0, 0.37])
def test_what_a_crack_parts_spins_about_the_middle_of_its_block(at: float, bonded: bool) -> None:
    # Each part spun about a middle of its own: a third of the energy, and faces pressed at once.
    parts = WHOLE.format(at=at, spin=SPIN, bonded="bonded = true" if bonded else "")
    history = run(1e-3, parts, BOND if bonded else "", NET).history
    energy = INERTIA * SPIN**2 / 2
    # Halves strain by rho omega^2 L^2 / (8 E) = 1.6e-3, which takes less than a thousandth.
    assert history["kinetic_energy"][0] == pytest.approx(energy, rel=1e-3)


def test_halves_that_turn_away_from_each_other_overlap_nowhere() -> None:
    # Tension over the middle is rho omega^2 L^2 / 8 = 1.6 of the strength.
    halves = "".join(
        f'[[blocks]]\nname = "{name}"\nmaterial = "m"\nvertices = {corners}\n'
        f'[[initial_velocities]]\nblock = "{name}"\n'
        f"velocity = [0.0, {way * FLIES}]\nangular_velocity = {SPIN}\n"
        for name, way, corners in (
            ("left", -1, [[-1, -0.1], [0, -0.1], [0, 0.1], [-1, 0.1]]),
            ("right", 1, [[0, -0.1], [1, -0.1], [1, 0.1], [0, 0.1]]),
        )
    )
    made = run(0.3, halves, BOND, 'type = "block"')
    # They are some 2 omega L / 4 t = 5 m apart, and have turned by 5.4 rad. The line of the joint
    # that was, which turns with one half, had the other behind it from 2.3 rad on: "5.7 m deep".
    assert np.array(made.history["broken"])[-1] > 0
    assert made.summary.status == "converged"
    assert max(made.history["penetration"]) < 1e-5
