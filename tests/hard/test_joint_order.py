"""Joints whose faces turn against each other: order of blocks, mirrors, turns, plain springs."""

import numpy as np
import pytest
from scipy.optimize import minimize

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import run

BLOCKS = {
    "base": [[0, 0], [2, 0], [2, 1], [0, 1]],
    "top": [[0.2, 1], [1.6, 1], [1.6, 2.1], [0.2, 2.1]],
}
COVERS = {
    "block": 'type = "block"',
    "rigid": 'type = "block"\nfunctions = "rigid"',
    "quads": 'type = "quads"\nsize = 0.5\ndegree = 1',
}
NORMAL, SHEAR = 1e8, 4e7
LAWS = {
    "springs": f"cohesion = 1e9\ntensile_strength = 1e9\nnormal_stiffness = {NORMAL}\n"
    f"shear_stiffness = {SHEAR}\nbonded = true",
    "glue": f"bonded = true\nnormal_stiffness = {NORMAL}\nshear_stiffness = {SHEAR}",
    "terms": "bonded = true\ncohesion = 1e9\ntensile_strength = 1e9",
    "loose": f"normal_stiffness = {NORMAL}\nshear_stiffness = {SHEAR}",
}


def image(points: list[list[float]], angle: float, mirrored: bool) -> list[list[float]]:
    """Points mirrored in y, then turned about the origin."""
    c, s = np.cos(angle), np.sin(angle)
    found = np.array(points, dtype=float) * ([-1, 1] if mirrored else [1, 1])
    return (found @ np.array([[c, s], [-s, c]])).tolist()


def answer(
    law: str,
    cover: str,
    order: tuple[str, ...],
    duration: float | None = None,
    angle: float = 0.0,
    mirrored: bool = False,
    push: float = 3e5,
    more: str = "",
) -> np.ndarray:
    """Way of a corner of the block that leans over (2,), and the work on it over its largest."""

    def at(points: list[list[float]]) -> list[list[float]]:
        return image(points, angle, mirrored)

    blocks = "".join(
        f'[[blocks]]\nname = "{name}"\nmaterial = "m"\n'
        f"vertices = {at(BLOCKS[name])[:: -1 if mirrored else 1]}\n"
        for name in order
    )
    tables = "" if law == "glue" else "[contact]\n"
    tables += "" if duration is None else "[inertia]\n"
    scene = (
        f'plane = "strain"\n{"" if duration is None else f"duration = {duration}"}\n'
        "[materials.m]\nyoung_modulus = 1e10\npoisson_ratio = 0.2\ndensity = 2000\n"
        f"[interfaces.i]\nfriction_angle = 0.5\n{LAWS[law]}\n{tables}{blocks}"
        f'[[supports]]\nname = "f"\nsegment = {at([[0, 0], [2, 0]])}\nfix = ["x", "y"]\n'
        f'[[loads]]\nname = "l"\nkind = "edge"\nsegment = {at([[0.2, 2.1], [1.6, 2.1]])}\n'
        f"traction = {at([[push, -push / 2]])[0]}\n"
        f'[[monitors]]\nname = "m"\npoint = {at([[0.2, 2.1]])[0]}\nblock = "top"\n{more}'
    )
    step = "" if duration is None else '[integrator]\ntype = "newmark"\nstep = 0.001\n'
    found = run(parse_scene(scene, "scene"), parse_formulation(f"[cover]\n{COVERS[cover]}\n{step}"))
    assert found.summary.status == "converged", found.summary.sentence
    way = np.array([[found.history[f"monitor:m:{axis}"][-1] for axis in ("ux", "uy")]])
    back = np.array(image(way.tolist(), -angle, False))[0] * ([-1, 1] if mirrored else [1, 1])
    return np.array([*back, found.history["external_work"][-1] / 5e3])


@pytest.mark.parametrize("cover", list(COVERS))
@pytest.mark.parametrize(
    ("law", "duration"),
    [("springs", None), ("springs", 0.02), ("glue", 0.02), ("terms", None), ("loose", 0.02)],
)
def test_joints_that_open_do_not_know_the_order_of_blocks(
    law: str, duration: float | None, cover: str
) -> None:
    push = 1e4 if law == "loose" else 3e5
    one = answer(law, cover, ("base", "top"), duration, push=push)
    other = answer(law, cover, ("top", "base"), duration, push=push)
    # Measured below 1e-11: rounding of places of 1 m over ways of millimetres, as it grows in time.
    np.testing.assert_allclose(other, one, rtol=0, atol=1e-9 * np.abs(one).max())


@pytest.mark.parametrize("law", ["springs", "glue"])
@pytest.mark.parametrize(("angle", "mirrored"), [(0.0, True), (0.7, False), (2.3, True)])
def test_joints_that_open_do_not_know_mirrors_and_turns(
    law: str, angle: float, mirrored: bool
) -> None:
    one = answer(law, "block", ("base", "top"), 0.02)
    other = answer(law, "block", ("top", "base"), 0.02, angle, mirrored)
    # Turned coordinates are rounded before anything is computed, and twenty steps amplify it:
    # measured 1.4e-8 of the work, 3e-15 where it is mirrored alone.
    np.testing.assert_allclose(other, one, rtol=0, atol=1e-7 * np.abs(one).max())


def leaning() -> np.ndarray:
    """Way of the corner of a rigid block on a still one, by the least energy of its two springs.

    Each spring is as long as half of the joint; it is stretched and sheared along the line half way
    between both faces.
    """
    ends, corner = np.array([[0.2, 1.0], [1.6, 1.0]]), np.array([0.2, 2.1])
    centre, middle = np.array([0.9, 1.55]), np.array([0.9, 2.1])
    pull = 1.4 * np.array([3e5, -1.5e5])

    def place(motion: np.ndarray, points: np.ndarray) -> np.ndarray:
        c, s = np.cos(motion[2]), np.sin(motion[2])
        return centre + motion[:2] + (points - centre) @ np.array([[c, s], [-s, c]])

    def energy(scaled: np.ndarray) -> float:
        motion = scaled / 100
        way, half = place(motion, ends) - ends, motion[2] / 2
        gap = way @ np.array([-np.sin(half), np.cos(half)])
        slip = way @ np.array([np.cos(half), np.sin(half)])
        springs = 0.35 * (NORMAL * gap @ gap + SHEAR * slip @ slip)
        return float(springs - pull @ (place(motion, middle) - middle)) / 1e3

    found = minimize(energy, np.zeros(3), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 0})
    return np.asarray(place(found.x / 100, corner) - corner)


@pytest.mark.parametrize("order", [("base", "top"), ("top", "base")])
def test_a_rigid_block_leans_to_the_least_energy_of_its_springs(order: tuple[str, ...]) -> None:
    held = '[[supports]]\nname = "g"\nblock = "base"\nfix = ["x", "y"]\n'
    found = answer("springs", "rigid", order, more=held)[:2]
    # The base gives by 1e-6 of the way, being held by springs; the corner turns by 6.8 mrad.
    np.testing.assert_allclose(found, leaning(), rtol=0, atol=3e-6 * np.abs(found).max())


def test_faces_that_slide_within_a_joint_are_pressed_by_nothing_else() -> None:
    """Cells slide on to the next ones of the face they are bonded to, and make no energy there."""
    # 0.5 % of the turnover and more came from contacts beside the bond: the run was unbalanced.
    assert answer("springs", "quads", ("base", "top"), 0.05)[0] > 5e-3
