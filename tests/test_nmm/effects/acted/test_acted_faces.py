"""Loads and supports on the faces of bonds and of glue, which Nitsche's terms hold."""

import numpy as np
import pytest

from nmm.effects.acted.acted_ends import ends_on_faces
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
    head: str = "",
    more: str = "",
    density: float | None = None,
) -> Run:
    """Run squares of 1 m, one upon the other, that a bond or (without strength) glue holds."""
    bond: dict[str, float | bool] = {"bonded": True}
    if strength is not None:
        bond |= {"cohesion": 1e9, "tensile_strength": strength}
    scene = text.scene(
        'plane = "stress"\n' + head + ("" if strength is None else "[contact]\n"),
        [
            text.material("soft", MODULUS, 0.0, density),
            text.material("other", modulus, 0.0, density),
            text.interface("joint", 30.0, ("soft", "other"), bond),
            text.block("low", "soft", text.rectangle((0, 0), (1, 1))),
            text.block("up", "other", text.rectangle((0, 1), (1, 2))),
            *acting,
            text.monitor("low", (0.5, 1), "low"),
            text.monitor("up", (0.5, 1), "up"),
        ],
    )
    method = "" if cover == "block" else method
    return run(parse_scene(scene), parse_formulation(COVERS[cover] + method + more))


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


# A spring of 1 N/m and a bar of 1 N lose 1e-6 of their force as the seam moves by 1 mm.
SPRING = """[[springs]]
name = "pull"
points = [[0.5, 1], [0.5, 3]]
blocks = ["{}", "ground"]
stiffness = 1.0
force = 1e3
"""
ENDING = {
    "spring": SPRING,
    "bar": SPRING.replace("springs", "bars").replace(
        "stiffness = 1.0\nforce", "area = 1e-6\nyoung_modulus = 1e6\npretension"
    ),
    "mass": '[gravity]\nacceleration = [0, 1e3]\n[[masses]]\nname = "pull"\npoint = [0.5, 1]\n'
    'block = "{}"\nmass = 1\n',
}


@pytest.mark.parametrize("strength", [1e9, None], ids=["bond", "glue"])
@pytest.mark.parametrize("block", ["up", "low"])
@pytest.mark.parametrize("member", ENDING)
def test_a_member_that_ends_at_a_seam_strains_the_block_below_alone(
    member: str, block: str, strength: float | None
) -> None:
    density = 1e-9 if member == "mass" else None
    found = two_squares(
        FOOT, ENDING[member].format(block), cover="block", strength=strength, density=density
    )
    low, up = stress_along(found)
    np.testing.assert_allclose(low, PULL, rtol=2e-6)
    np.testing.assert_allclose(up, 0.0, atol=2e-6 * PULL)


def test_a_dashpot_acts_on_the_face_that_it_ends_at() -> None:
    dashpot = SPRING.replace("springs", "dashpots").replace(
        "stiffness = 1.0\nforce", "viscosity = 1.0\n#"
    )
    moving = "duration = 1e-3\n[inertia]\n"
    found = two_squares(
        FOOT, dashpot.format("up"), cover="block", strength=None, head=moving, density=1.0
    )
    (tie,) = found.stepper.plan.effects["bonded interfaces"].ties
    upper = [side.points.body[0] == 1 for side in tie.interface.sides]
    assert [one.all() for one in tie.interface.acted] == upper


def test_a_spring_between_both_faces_of_a_seam_is_told() -> None:
    across = '[[springs]]\nname = "clamp"\npoints = [[0.25, 1], [0.75, 1]]\nstiffness = 1.0\n'
    found = two_squares(FOOT, across + 'blocks = ["low", "up"]\n', cover="block")
    (told,) = [one for one in found.summary.warnings if '"clamp" on both faces' in one]
    assert 'bonds = "spring"' in told


def test_members_beside_a_crack_end_on_one_of_its_faces() -> None:
    scene = text.scene(
        'plane = "stress"\n',
        [
            text.material("soft", MODULUS, 0.0, None),
            text.block("whole", "soft", text.rectangle((0, 0), (1, 1))),
            '[[cracks]]\nname = "slit"\npoints = [[-0.1, 0.6], [0.7, 0.6]]\n',
            text.fixed_block("whole"),
        ],
    )
    found = run(parse_scene(scene), parse_formulation(COVERS["triangles"]))
    middle = found.manifold.elements.centroids
    below = np.flatnonzero(middle[:, 1] < 0.6)
    at = np.argmin(np.hypot(*(middle[below] - [0.4, 0.6]).T))
    parts = ends_on_faces(found.manifold, np.array([[0.4, 0.6]]), below[[at]])
    edges = found.manifold.boundary
    assert len(parts.edge)
    assert (edges.end[parts.edge, 0] < edges.start[parts.edge, 0]).all()  # matter is below


@pytest.mark.parametrize("strength", [1e9, None], ids=["bond", "glue"])
@pytest.mark.parametrize("cover", ["block", "triangles"])
def test_a_force_that_travels_along_a_seam_strains_the_block_below_alone(
    cover: str, strength: float | None
) -> None:
    """Spread over 1 m and at the end of it, it pulls the whole seam evenly."""
    wheel = load("up", f"force = [0, {PULL}]\nspeed = 1.0\nspread = 1.0", "moving")
    steps = {"head": "duration = 1.0\n", "more": "[integrator]\nstep = 1.0\n"}
    found = two_squares(FOOT, wheel, cover=cover, strength=strength, **steps)
    low, up = stress_along(found)
    np.testing.assert_allclose(low, PULL, rtol=1e-6)
    np.testing.assert_allclose(up, 0.0, atol=1e-6 * PULL)


STAGES = '[[stages]]\nname = "one"\nloads = {}\n[[stages]]\nname = "two"\nloads = {}\n'


@pytest.mark.parametrize(
    ("first", "then", "pull"),
    [(["top"], ["top", "pull"], PULL), (["top", "pull"], ["top"], 0.0), (["top"], ["top"], 0.0)],
    ids=["comes", "goes", "never"],
)
def test_a_joint_turns_as_it_does_when_a_load_on_its_face_comes_or_goes(
    first: list[str], then: list[str], pull: float
) -> None:
    """Blocks of one strain turn against each other by the moment on ``E / h`` of the joint."""
    leans = load("up", f'field = ["0", "{PULL}*x"]', place="segment = [[0, 2], [1, 2]]")
    stages = STAGES.format(first, then).replace("'", '"')
    seam = load("up", f"traction = [0, {PULL}]")
    edges = [text.monitor(f"{name} edge", (0, 1), name) for name in ("low", "up")]
    acting = FOOT, leans.replace("pull", "top"), seam, *edges, stages
    found = two_squares(*acting, cover="block", more='[rotation]\nupdate = "small"\n')
    low, up = stress_along(found)
    # int x dx = 1/2, and 1/12 about the middle over 1/12 of E / h at two Gauss points.
    np.testing.assert_allclose(up, PULL / 2, rtol=1e-5)
    np.testing.assert_allclose(low, PULL / 2 + pull, rtol=1e-5)
    ways = (found.history[f"monitor:{name} edge:uy"][-1] for name in ("low", "up"))
    assert next(ways) - next(ways) == pytest.approx(0.5 * PULL / MODULUS, rel=1e-5)


def column(*acting: str) -> Run:
    """Run a block of 1 m by 2 m that is two squares, which Nitsche's terms glue."""
    scene = text.scene(
        'plane = "stress"\n',
        [
            text.material("soft", MODULUS, 0.0, None),
            text.block("up", "soft", text.rectangle((0, 0), (1, 2))),
            FOOT,
            *acting,
        ],
    )
    cover = '[cover]\ntype = "sub_blocks"\nsize = 1.0\n[cover.options]\nmesh = "quads"\n'
    return run(parse_scene(scene), parse_formulation(cover + 'glue = "nitsche"\n'))


@pytest.mark.parametrize("member", ["spring", "bar"])
def test_a_member_that_ends_between_sub_blocks_strains_the_one_below_alone(member: str) -> None:
    low, up = stress_along(column(ENDING[member].format("up")))
    np.testing.assert_allclose(low, PULL, rtol=2e-6)
    np.testing.assert_allclose(up, 0.0, atol=2e-6 * PULL)


def test_water_between_sub_blocks_is_told_with_what_to_do() -> None:
    water = f'[[water_pressures]]\nname = "uplift"\npressure = {PULL}\nblock = "up"\n'
    (told,) = column(water).summary.warnings
    assert '"uplift" on both faces at (0.5, 1) of sub-blocks' in told
    assert 'glue = "springs"' in told
