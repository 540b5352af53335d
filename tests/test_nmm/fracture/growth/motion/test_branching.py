"""Tips that divide in two: when, which way, what their branches have, and where it is refused."""

import numpy as np
import pytest

import nmm
from nmm.effects.base import Instant
from nmm.errors import NmmError
from nmm.formulation import Formulation, parse_formulation
from nmm.scene.model import Scene
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

PULLED = """
plane = "strain"
[materials.m]
young_modulus = 10e6
poisson_ratio = 0.3
density = 1000
[[blocks]]
name = "plate"
material = "m"
vertices = [[0, -0.5], [2, -0.5], [2, 0.5], [0, 0.5]]
{cracks}
[[loads]]
name = "up"
kind = "edge"
segment = [[2, 0.5], [0, 0.5]]
traction = [0, 4e3]
[[loads]]
name = "down"
kind = "edge"
segment = [[0, -0.5], [2, -0.5]]
traction = [0, -4e3]
[fracture]
toughness = 4000.0
increment = 0.16
"""
NOTCH = '[[cracks]]\nname = "notch"\npoints = [[-0.1, 0.0], [0.5, 0.0]]\n'
TIME = "[inertia]\n"


def net(size: float = 0.125) -> Formulation:
    return parse_formulation(f"""
        [cover]
        type = "triangles"
        size = {size}
        angle = 0.3
        shift = [0.13, 0.27]
        degree = 1
        [integrator]
        type = "newmark"
        step = 0.0004
        """)


def running(branching: str, duration: float = 0.0116) -> Scene:
    text = PULLED.format(cracks=NOTCH) + branching
    return parse_scene(f"duration = {duration}\n{text}\n{TIME}")


def test_a_tip_divides_where_twice_the_fracture_energy_comes_in() -> None:
    scene = running('branching = "25 deg"')
    run = nmm.run(scene, net())
    history = run.history
    whole, right = run.stepper.discretisation.setup.geometry.cracks
    # Both leave the tip alike, by 25 degrees of where the criterion would have gone: straight on.
    assert np.array_equal(right[0], [0.5, 0.0])
    left = whole[-1] - whole[-2]
    way = right[1] - right[0]
    assert np.hypot(*left) == pytest.approx(0.16, abs=1e-12)
    assert np.arccos(left @ way / 0.16**2) == pytest.approx(np.deg2rad(50), abs=1e-9)
    assert left == pytest.approx(way * [1, -1], abs=0.01)
    share = history["fracture:notch:end:share"]
    before = int(np.flatnonzero(np.diff(history["fracture:growth"]) > 0)[0])
    assert share[before] ** 2 >= 2.0
    assert history["fracture:growth"][-1] == pytest.approx(0.32)
    modulus = 10e6 / (1 - 0.3**2)
    assert history["fracture:energy"][-1] == pytest.approx(0.32 * 4000.0**2 / modulus)
    # What comes in is shared, so that neither divides at once.
    assert history["fracture:branch 1:share"][-1] ** 2 < 2.0


def test_without_being_asked_to_a_tip_stays_one() -> None:
    run = nmm.run(running(""), net())
    assert len(run.stepper.discretisation.setup.geometry.cracks) == 1


@pytest.mark.parametrize("pieces", [2, 3])
def test_a_tip_divides_after_the_length_that_is_asked_for_whatever_its_pieces(pieces: int) -> None:
    asked = 'branching = "25 deg"\nbranching_length = 0.24'
    plate = PULLED.format(cracks=NOTCH).replace("= 0.16", f"= {0.24 / pieces}")
    scene = parse_scene(f"duration = 0.0204\n{plate}{asked}\n{TIME}")
    run = nmm.run(scene, net())
    whole, right = run.stepper.discretisation.setup.geometry.cracks
    # By 0.24 straight on, each piece within a cut's 1e-3 of a cell.
    assert right[0] == pytest.approx([0.5 + 0.24, 0.0], abs=0.02)
    assert len(whole) >= pieces + 3


def test_a_length_of_branching_without_branching_is_refused() -> None:
    text = PULLED.format(cracks=NOTCH) + f"branching_length = 0.1\n{TIME}"
    with pytest.raises(NmmError, match="branching_length"):
        parse_scene(f"duration = 0.01\n{text}")


def test_branches_of_cracks_in_equilibrium_are_refused() -> None:
    text = PULLED.format(cracks=NOTCH) + 'branching = "25 deg"\n[gravity]\n'
    with pytest.raises(NmmError, match="branching"):
        parse_scene(text)


def forked(length: float) -> tuple[float, float]:
    """Strain energy (J) of a crack with two branches under its load, and G of both (J/m2)."""
    c, s = length * np.cos(0.5), length * np.sin(0.5)
    cracks = (
        f'[[cracks]]\nname = "up"\npoints = [[-0.1, 0.0], [0.5, 0.0], [{0.5 + c}, {s}]]\n'
        f'[[cracks]]\nname = "down"\npoints = [[0.5, 0.0], [{0.5 + c}, {-s}]]\n'
    )
    pin = (
        '[[supports]]\nname = "pin"\npoint = [2, 0]\nfix = ["x", "y"]\n'
        '[[supports]]\nname = "slot"\npoint = [1.8, 0]\nfix = ["y"]\n'
    )
    made = prepare(parse_scene(PULLED.format(cracks=cracks + pin)), net(0.08))
    attempt = made.stepper.attempt(made.start, Instant(0.0, 1.0), None)
    stepper, state = made.stepper, attempt.state
    assert stepper.plan.fracture is not None
    found = stepper.plan.fracture.intensities(state)
    assert len(found.rate) == 2
    return stepper.model.strain_energy(state), float(found.rate.sum())


def test_what_both_branches_release_is_what_the_work_says() -> None:
    """Under a constant load the strain energy grows by what two tips release."""
    half = 0.02
    less, more = (forked(0.3 + way)[0] for way in (-half, half))
    assert forked(0.3)[1] == pytest.approx((more - less) / (2 * half), rel=0.02)
