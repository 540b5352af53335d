"""Blocks that split and cracks that grow in a stage are what the next stages begin with."""

import numpy as np
import pytest

import nmm
from nmm.testing.resumed.stopping import check_goes_on

CRUSHED = """
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000
[materials.steel]
young_modulus = 1e9
poisson_ratio = 0.0
density = 4000
[[blocks]]
name = "floor"
material = "steel"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[blocks]]
name = "left"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[blocks]]
name = "roof"
material = "steel"
vertices = [[0, 1], [2, 1], [2, 2], [0, 2]]
[[blocks]]
name = "late"
material = "steel"
vertices = [[-1, 0], [0, 0], [0, 1], [-1, 1]]
[gravity]
acceleration = [0, -10]
[contact]
[interfaces.dry]
friction_angle = "35 deg"
[[supports]]
name = "held"
segment = [[-1, -1], [3, -1]]
fix = ["x", "y"]
[[supports]]
name = "aligned"
segment = [[0, 1], [0, 2]]
block = "roof"
fix = ["x"]
[[supports]]
name = "walled"
segment = [[0, 0], [0, 1]]
block = "left"
fix = ["x"]
[splitting.rock]
tensile_strength = 1e4
cohesion = 3e4
friction_angle = 0.3
smallest_block = 0.1
most_blocks = 16
[[loads]]
name = "push"
kind = "edge"
segment = [[0, 2], [2, 2]]
traction = [0, -1e5]
[[stages]]
name = "in place"
remove = ["late"]
loads = []
[[stages]]
name = "loaded"
loads = ["push"]
[[stages]]
name = "unloaded"
loads = []
add = ["late"]
"""
WEIGHT = 10 * (2 * 2000 + (4 + 2) * 4000)


@pytest.fixture(scope="module")
def crushed():
    """The run of pillars that are crushed in a stage."""
    return nmm.run(nmm.parse_scene(CRUSHED))


def test_pieces_of_a_stage_bear_the_weight_of_the_next_one(crushed):
    found = crushed
    assert found.summary.status == "converged", found.summary.sentence
    bodies, load = found.history["splitting:bodies"], found.history["reaction:held:y"]
    assert bodies[0] == 4
    assert bodies[-1] > 8  # each pillar more than once, and the block that arrives
    loaded = np.flatnonzero(found.history["load_factor"] == 1.0)
    # Walls take no load upright; the solution of contact leaves 1e-8 of the forces.
    assert load[loaded[[0, -2, -1]]] == pytest.approx(
        [WEIGHT, WEIGHT + 2e5, WEIGHT + 4e4], rel=1e-7
    )
    area = sum(one.area for one in found.topologies[-1].elements.to_shapely())
    assert area == pytest.approx(4 + 2 + 2 + 1, rel=1e-12)


def test_displacements_of_pieces_count_from_a_stage_whatever_is_stored(tmp_path):
    seen = '[[monitors]]\nname = "top"\npoint = [1, 2]\nblock = "roof"\n'
    text = CRUSHED.replace('name = "loaded"', 'name = "loaded"\nreset_displacements = true') + seen
    stores = nmm.parse_scene(text + "[output.checkpoint]\nevery_steps = 1\n")
    whole = check_goes_on(stores, tmp_path, 20)
    alone = nmm.run(nmm.parse_scene(text))
    loaded = np.flatnonzero(whole.history["load_factor"] == 1.0)
    way, other = (one.history["monitor:top:uy"][loaded] for one in (whole, alone))
    # Stages at rest under contact are solved to 1e-8 of the forces.
    assert way == pytest.approx(other, rel=1e-5)


def test_what_happens_is_told_in_the_order_of_time(crushed):
    told = crushed.summary.changes
    assert told[0].startswith("stage loaded at 1:")
    assert all("split into" in one for one in told[1:-1])
    assert told[-1].startswith("stage unloaded at 2: 1 blocks added")


NOTCHED = """
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "plate"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[cracks]]
name = "notch"
points = {notch}
[[supports]]
name = "held"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [5e4, 1e6]
[[loads]]
name = "other"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [-2e3, 4e4]
[[monitors]]
name = "corner"
point = [0, 1]
[fracture]
energy = 100.0
increment = 0.05
max_growth = {growth}
[[stages]]
name = "pulled"
loads = ["pull"]
{times}
[[stages]]
name = "otherwise"
loads = ["other"]
[formulation.cover]
type = "quads"
size = 0.125
degree = 1
[formulation.integrator]
type = "newmark"
step = 1e-4
"""
STRAIGHT = [[0.0, 0.51], [0.45, 0.51]]


def test_a_crack_that_grew_in_a_stage_is_the_crack_of_the_next_one():
    """What is elastic does not know how the crack came to be: it may as well be drawn."""
    text = NOTCHED.format(notch=STRAIGHT, growth=0.2, times="")
    grown = nmm.run(nmm.parse_scene(text))
    assert grown.summary.status == "converged", grown.summary.sentence
    assert grown.history["fracture:growth"][-1] == pytest.approx(0.2, rel=1e-12)
    ends = [grown.history[f"fracture:notch:end:{axis}"] for axis in "xy"]
    way = np.unique(np.round(np.transpose(ends), 12), axis=0)
    drawn = nmm.run(
        nmm.parse_scene(
            NOTCHED.format(notch=[STRAIGHT[0], *way.tolist()], growth=1e-9, times="").replace(
                'loads = ["pull"]', 'loads = ["other"]'
            )
        )
    )
    for name in ("monitor:corner:ux", "monitor:corner:uy", "fracture:notch:end:K_I"):
        # The kinks of one are found from its last piece, those of the other were read.
        assert grown.history[name][-1] == pytest.approx(drawn.history[name][-1], rel=1e-6), name


def test_a_crack_grows_in_time_and_rests_in_a_stage_after():
    text = NOTCHED.format(notch=STRAIGHT, growth=0.2, times="duration = 4e-3") + "[inertia]\n"
    grown = nmm.run(nmm.parse_scene(text))
    assert grown.summary.status == "converged", grown.summary.sentence
    assert grown.history["fracture:growth"][-1] == pytest.approx(0.2, rel=1e-12)
    assert grown.history["reaction:held:y"][-1] == pytest.approx(-4e4, rel=1e-6)


SOFT = """
[materials.soft]
young_modulus = 5e8
poisson_ratio = 0.2
density = 2000
"""
SIDE = """
[[blocks]]
name = "side"
material = "rock"
vertices = [[1, 0], [1.5, 0], [1.5, 1], [1, 1]]
[interfaces.glue]
bonded = true
friction_angle = 0.5
[contact]
"""
HEAT = """
[heat]
[[temperatures]]
name = "cool"
block = "plate"
temperature = 0.0
[[temperatures]]
name = "warm"
block = "plate"
temperature = 100.0
"""
EXPANDS = "density = 2000\nthermal_expansion = 1e-5\nconductivity = 1.0"
OTHERWISE = 'name = "otherwise"\n'


def otherwise(text: str, keys: str, more: str = "", first: str = "") -> nmm.stepping.run.Run:
    """Run stages of which the second has other keys, the first as well."""
    text = text.replace(OTHERWISE, OTHERWISE + keys).replace(
        'name = "pulled"\n', f'name = "pulled"\n{first}'
    )
    return nmm.run(nmm.parse_scene(text.replace("[[cracks]]", f"{more}[[cracks]]", 1)))


@pytest.mark.parametrize(
    ("keys", "more", "first", "share"),
    [
        ('materials = {plate = "soft"}\n', SOFT, "", 2e-4),
        # The side comes loose: nobody keeps account of work where relaxation brings it to rest.
        ('remove = ["side"]\n', SIDE, "", 4e-3),
        ('heat = ["warm"]\n', HEAT, 'heat = ["cool"]\n', 2e-4),
    ],
)
def test_what_a_stage_changes_is_not_freed_by_a_crack_that_stays(keys, more, first, share):
    text = NOTCHED.format(notch=STRAIGHT, growth=1e-9, times="").replace("100.0", "1e9")
    run = otherwise(text.replace("density = 2000", EXPANDS, 1), keys, more, first)
    changed = max(abs(run.summary.change_energy), *run.history["strain_energy"])
    assert run.summary.status == "converged"
    assert changed > 500.0
    # No crack grows; energies of a run are found to 1e-4 of what changed.
    assert abs(run.summary.freed_energy) < share * changed


@pytest.mark.parametrize("share", [0.5, pytest.param(0.2, marks=pytest.mark.slow), 0.05])
def test_a_cracked_plate_whose_loose_side_goes_finds_its_equilibrium_under_any_load(share):
    """Its last corrections move by 1e-12 m: what dependent functions leave of them is rounding."""
    text = NOTCHED.format(notch=STRAIGHT, growth=1e-9, times="").replace("100.0", "1e9")
    for x, y in ((5e4, 1e6), (-2e3, 4e4)):
        text = text.replace(
            f"[{x:.0e}, {y:.0e}]".replace("e+0", "e"), f"[{share * x}, {share * y}]"
        )
    assert text.count(f"{share * 1e6}") == 1
    run = otherwise(text, 'remove = ["side"]\n', SIDE)
    assert run.summary.status == "converged"


def test_a_crack_frees_as_much_in_a_body_that_has_expanded_freely():
    text = NOTCHED.format(notch=STRAIGHT, growth=0.2, times="")
    text = text.replace("density = 2000", EXPANDS).replace(
        'segment = [[0, 0], [1, 0]]\nfix = ["x", "y"]',
        'segment = [[0, 0], [1, 0]]\nfix = ["y"]\n[[supports]]\nname = "foot"\npoint = [0, 0]\n'
        'fix = ["x"]',
    )
    last = text.replace('loads = ["pull"]', "loads = []").replace('["other"]', '["pull"]')
    cold = otherwise(last, "")
    warm = otherwise(last, 'heat = ["warm"]\n', HEAT, 'heat = ["warm"]\n')
    assert cold.summary.fracture_energy == pytest.approx(20.0, rel=1e-12)
    # Intensities beside heat are found to 1e-4, and the way of the crack to 1e-5 m with them.
    assert warm.summary.freed_energy == pytest.approx(cold.summary.freed_energy, rel=2e-4)


def test_blocks_split_while_what_others_exerted_is_released(tmp_path):
    beside = CRUSHED.replace(
        "[[-1, 0], [0, 0], [0, 1], [-1, 1]]", "[[2.2, 0], [3, 0], [3, 1], [2.2, 1]]"
    ).replace('remove = ["late"]\n', "")
    text = beside.replace('name = "loaded"', 'name = "loaded"\nremove = ["late"]\nrelease = 0.25')
    text = text.replace('loads = []\nadd = ["late"]', "loads = []\nrelease = 1.0")
    text = text.replace("[[stages]]", "[output]\ncheckpoint = { every_steps = 3 }\n[[stages]]", 1)
    run = check_goes_on(nmm.parse_scene(text), tmp_path)
    assert run.summary.status == "converged", run.summary.sentence
    assert any("split into" in one for one in run.summary.changes)
    time, floor = (run.history[name] for name in ("time", "reaction:held:y"))
    ends = [np.flatnonzero(time <= end)[-1] for end in (1.0, 2.0, 3.0)]
    # Weights: 1.6e5 of the floor, 2e4 of each rock, 8e4 of the roof, 3.2e4 of what leaves.
    exact = 2.8e5 + np.array([3.2e4, 0.75 * 3.2e4 + 2e5, 0.0])
    # Contact is solved to 1e-8 of the forces.
    assert floor[ends] == pytest.approx(exact, rel=1e-7)
    # On its way the share goes on as it did before blocks split.
    way = (time > 1.0) & (time <= 2.0)
    share = run.history["unreleased forces:share"][way]
    assert share == pytest.approx(1.0 - 0.25 * (time[way] - 1.0), rel=1e-12)


ABOVE = """
[[blocks]]
name = "above"
material = "rock"
vertices = [[0, 1], [1, 1], [1, 1.5], [0, 1.5]]
[interfaces.glue]
bonded = true
friction_angle = 0.5
"""
LEAVES = """
[[stages]]
name = "in place"
loads = ["pull"]
[[stages]]
name = "gone"
remove = ["above"]
release = 0.5
loads = ["other"]
[[stages]]
name = "rest"
release = 1.0
"""


def test_a_crack_grows_while_what_a_block_exerted_is_released():
    """At the end nothing is left of the block, and the crack may as well be drawn."""
    base = NOTCHED.format(notch=STRAIGHT, growth=0.2, times="")
    base = base.replace("[5e4, 1e6]", "[0, 6e4]").replace("[-2e3, 4e4]", "[4e3, 8e4]")
    begin, end = base.index("[[stages]]"), base.index("[formulation.cover]")
    text = base[:begin] + LEAVES + base[end:]
    text = text.replace('name = "pull"\n', 'name = "pull"\nblock = "above"\n')
    text = text.replace('name = "other"\n', 'name = "other"\nblock = "plate"\n')
    text = text.replace('name = "corner"\n', 'name = "corner"\nblock = "plate"\n')
    # The block is pulled at its upper edge, the plate at its own once the block has gone.
    text = text.replace("[[0, 1], [1, 1]]", "[[0, 1.5], [1, 1.5]]", 1)
    grown = nmm.run(nmm.parse_scene(text.replace("[[cracks]]", ABOVE + "[[cracks]]")))
    assert grown.summary.status == "converged", grown.summary.sentence
    assert grown.history["fracture:growth"][-1] == pytest.approx(0.2, rel=1e-12)
    assert any("at 1." in one and "grew" in one for one in grown.summary.changes)
    time, held = grown.history["time"], grown.history["reaction:held:y"]
    ends = [np.flatnonzero(time <= at)[-1] for at in (1.0, 2.0, 3.0)]
    # Forces at the faces may miss a thousandth of what they hold.
    assert held[ends] == pytest.approx([-6e4, -8e4 - 3e4, -8e4], abs=1e-3 * 3e4)
    ways = [grown.history[f"fracture:notch:end:{axis}"] for axis in "xy"]
    way = np.unique(np.round(np.transpose(ways), 12), axis=0)
    drawn = NOTCHED.format(notch=[STRAIGHT[0], *way.tolist()], growth=1e-9, times="")
    drawn = drawn.replace("[-2e3, 4e4]", "[4e3, 8e4]").replace("100.0", "1e9")
    alone = nmm.run(nmm.parse_scene(drawn))
    for name in ("monitor:corner:ux", "monitor:corner:uy", "fracture:notch:end:K_I"):
        # The kinks of one are found from its last piece, those of the other were read.
        assert grown.history[name][-1] == pytest.approx(alone.history[name][-1], rel=1e-5), name
