"""Loads and supports on the faces of bonds and of glue, which Nitsche's terms hold."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import Run, run
from nmm.verification import text

COVERS = {
    "block": '[cover]\ntype = "block"\n',
    "triangles": '[cover]\ntype = "triangles"\nsize = 0.5\ndegree = 0\n',
    "triangles1": '[cover]\ntype = "triangles"\nsize = 0.5\ndegree = 1\n',
    "quads": '[cover]\ntype = "quads"\nsize = 0.5\ndegree = 0\nangle = 0.3\n',
    "quads2": '[cover]\ntype = "quads"\nsize = 0.5\ndegree = 2\n',
}
MODULUS, PULL = 1e6, 1e3
SEAM = [[0, 1], [1, 1]]
# Multipliers hold edges of meshes exactly, springs of 1000 E those of blocks.
EXACT = '[supports]\nmethod = "lagrange"\n'


def load(block: str, magnitude: str, kind: str = "edge", place: str = f"segment = {SEAM}") -> str:
    """Table of a load."""
    return f'[[loads]]\nname = "pull"\nkind = "{kind}"\n{magnitude}\n{place}\nblock = "{block}"\n'


def hold(name: str, place: str) -> str:
    """Table of a support."""
    return f'[[supports]]\nname = "{name}"\n{place}\nfix = ["x", "y"]\n'


FOOT, TOP = hold("foot", "segment = [[0, 0], [1, 0]]"), hold("top", "segment = [[0, 2], [1, 2]]")
AT_TOP = load("up", f"traction = [0, {PULL}]", place="segment = [[0, 2], [1, 2]]").replace(
    "pull", "top"
)


def two_squares(
    *acting: str,
    cover: str,
    strength: float | None = 1e9,
    modulus: float = MODULUS,
    method: str = EXACT,
) -> Run:
    """Run squares of 1 m, one upon the other, that a bond or (without strength) glue holds."""
    bond: dict[str, float | bool] = {"bonded": True}
    if strength is not None:
        bond |= {"cohesion": 1e9, "tensile_strength": strength}
    scene = text.scene(
        'plane = "stress"\n' + ("" if strength is None else "[contact]\n"),
        [
            text.material("soft", MODULUS, 0.0, None),
            text.material("other", modulus, 0.0, None),
            text.interface("joint", 30.0, ("soft", "other"), bond),
            text.block("low", "soft", text.rectangle((0, 0), (1, 1))),
            text.block("up", "other", text.rectangle((0, 1), (1, 2))),
            *acting,
            text.monitor("low", (0.5, 1), "low"),
            text.monitor("up", (0.5, 1), "up"),
        ],
    )
    method = "" if cover == "block" else method
    return run(parse_scene(scene), parse_formulation(COVERS[cover] + method))


def stress_along(found: Run) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertical stress of the elements of the lower block, and of the upper one."""
    body = found.manifold.element_body
    return found.stress[body == 0, 1], found.stress[body == 1, 1]


ON_A_FACE = {
    "edge": load("up", f"traction = [0, {PULL}]"),
    "edge below": load("low", f"traction = [0, {PULL}]"),
    "field": load("up", f'field = ["0", "{PULL}"]'),
    "pressure": load("up", f"pressure = {PULL}", "pressure"),
    "water": f'[[water_pressures]]\nname = "pull"\npressure = {PULL}\nsegment = {SEAM}\n'
    'block = "up"\n',
}


@pytest.mark.parametrize("strength", [1e9, None], ids=["bond", "glue"])
@pytest.mark.parametrize(
    ("cover", "acting"),
    [*(("triangles", one) for one in ON_A_FACE), *((one, "edge") for one in COVERS)],
)
def test_what_pulls_a_face_of_a_seam_strains_the_block_below_alone(
    cover: str, acting: str, strength: float | None
) -> None:
    found = two_squares(FOOT, ON_A_FACE[acting], cover=cover, strength=strength)
    low, up = stress_along(found)
    # Stress is uniform in either block, of which all covers are capable: 1e-6 is of the steps.
    np.testing.assert_allclose(low, PULL, rtol=1e-6)
    np.testing.assert_allclose(up, 0.0, atol=1e-6 * PULL)


@pytest.mark.parametrize("strength", [1e9, None], ids=["bond", "glue"])
@pytest.mark.parametrize("modulus", [1e-3 * MODULUS, 1e3 * MODULUS])
def test_a_pulled_face_beside_softer_or_stiffer_matter_is_held_as_well(
    modulus: float, strength: float | None
) -> None:
    pull = load("up", f"traction = [0, {PULL}]")
    found = two_squares(FOOT, pull, cover="triangles", strength=strength, modulus=modulus)
    low, up = stress_along(found)
    # Of the steps and of matrices whose entries differ by 1e3.
    np.testing.assert_allclose(low, PULL, rtol=1e-6)
    np.testing.assert_allclose(up, 0.0, atol=1e-6 * PULL)


@pytest.mark.parametrize("strength", [1e9, None], ids=["bond", "glue"])
@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize(
    "held", ['segment = [[0, 1], [1, 1]]\nblock = "low"', 'block = "low"'], ids=["face", "block"]
)
def test_a_face_that_is_held_at_the_seam_hands_no_pull_on(
    held: str, cover: str, strength: float | None
) -> None:
    foot = () if held.startswith("block") else (FOOT,)
    found = two_squares(*foot, hold("seam", held), AT_TOP, cover=cover, strength=strength)
    low, up = stress_along(found)
    # Springs of 1000 E along two edges leave 1 / 3000 to the block, multipliers nothing.
    np.testing.assert_allclose(low, 0.0, atol=(5e-4 if cover == "block" else 1e-6) * PULL)
    np.testing.assert_allclose(up, PULL, rtol=1e-6)


@pytest.mark.parametrize("method", ["auto", "nitsche"])
def test_nitsche_s_supports_know_no_traction_on_faces_of_joints(method: str) -> None:
    """It is shared with the bond there: left to choose, springs hold them; else it is told."""
    scene = (FOOT, hold("seam", f'segment = {SEAM}\nblock = "low"'), AT_TOP)
    given = f'[supports]\nmethod = "{method}"\n'
    found = two_squares(*scene, cover="triangles", method=given)
    low, up = stress_along(found)
    told = [one for one in found.summary.warnings if '"seam" on faces of joints' in one]
    assert bool(told) == (method == "nitsche")
    if method == "auto":  # springs of 100 E over a cell of 0.5 m, beside 1 m of E above it
        np.testing.assert_allclose(low, 0.0, atol=5e-3 * PULL)
        np.testing.assert_allclose(up, PULL, rtol=1e-6)


@pytest.mark.parametrize("strength", [0.999 * PULL, 1.001 * PULL])
def test_a_bond_under_a_pulled_face_breaks_at_its_strength(strength: float) -> None:
    """Nothing else holds the block that is pulled, which then flies away."""
    pull = load("low", f"traction = [0, {-PULL}]"), AT_TOP
    found = two_squares(FOOT, *pull, cover="triangles", strength=strength)
    assert (found.summary.status == "converged") == (strength > PULL)


def test_the_load_of_a_broken_bond_is_on_its_own_face_and_energy_adds_up() -> None:
    # Two springs of E / 1 m share the load: each half of it. Above alone all of it.
    found = two_squares(
        FOOT, TOP, load("up", f"traction = [0, {PULL}]"), cover="triangles", strength=0.4 * PULL
    )
    low, up = stress_along(found)
    np.testing.assert_allclose(low, 0.0, atol=1e-6 * PULL)
    np.testing.assert_allclose(up, -PULL, rtol=1e-6)
    assert found.summary.status == "converged"


@pytest.mark.parametrize(
    ("strength", "remedy"), [(1e9, 'bonds = "spring"'), (None, 'method = "lagrange"')]
)
def test_loads_on_both_faces_are_told_with_what_to_do(strength: float | None, remedy: str) -> None:
    water = f'[[water_pressures]]\nname = "uplift"\npressure = {PULL}\nsegment = {SEAM}\n'
    found = two_squares(FOOT, water, cover="block", strength=strength)
    (told,) = [one for one in found.summary.warnings if '"uplift" on both faces' in one]
    assert remedy in told
    assert "(0.5, 1)" in told


def test_a_load_beside_a_joint_on_the_same_edge_acts_on_no_bond() -> None:
    """The edge of the base goes on beyond the block that is bonded to it."""
    beside = load("low", f"traction = [0, {-PULL}]", place="segment = [[1, 1], [2, 1]]")
    scene = text.scene(
        'plane = "stress"\n',
        [
            text.material("soft", MODULUS, 0.0, None),
            text.interface("joint", 30.0, ("soft", "soft"), {"bonded": True}),
            text.block("low", "soft", text.rectangle((0, 0), (2, 1))),
            text.block("up", "soft", text.rectangle((0, 1), (1, 2))),
            hold("foot", "segment = [[0, 0], [2, 0]]"),
            beside,
        ],
    )
    found = run(parse_scene(scene), parse_formulation(COVERS["block"]))
    (tie,) = found.stepper.plan.effects["bonded interfaces"].ties
    assert tie.interface.acted is None
