"""Blocks that leave and arrive, and covers that change, from one stage to the next."""

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError, NmmError, SceneError
from nmm.model.origin import shifted
from nmm.results.storage.stored_run import read_run
from nmm.scene.read import parse_scene
from nmm.testing.scenes import STACKED

E, RHO, G = 1e9, 2000.0, 10.0
LOWER, UPPER = RHO * G * 1.0, RHO * G * 2.0
STAGES = """
[[stages]]
name = "both"
[[stages]]
name = "unloaded"
remove = ["upper"]
[[stages]]
name = "back"
add = ["upper"]
"""
MESHES = {
    "triangles": {"type": "triangles", "size": 0.5, "degree": 1},
    "quads": {"type": "quads", "size": 0.5, "degree": 1},
    "graded": {"type": "graded", "size": 0.5, "degree": 1, "options": {"focus": [[0.0, 0.0]]}},
    "bspline": {"type": "bspline", "size": 0.5, "degree": 0},
    "mls": {"type": "mls", "size": 0.4, "degree": 0, "options": {"degree": 2}},
    "blocks of degree 2": {"type": "block", "functions": "monomials", "degree": 2},
}


def run(scene, cover, **more):
    table = {"cover": cover, **more}
    return nmm.run(parse_scene(scene), nmm.Formulation.model_validate(table))


def test_a_support_whose_block_has_left_is_refused_with_the_key_that_lists_others():
    roof = '[[supports]]\nname = "roof"\nsegment = [[0, 3], [1, 3]]\nfix = ["x"]\n'
    with pytest.raises(NmmError, match="or list the supports of the stage without it"):
        run(STACKED + roof + STAGES, MESHES["quads"])


@pytest.mark.parametrize("cover", ["triangles", "quads", "graded"])
def test_a_column_carries_the_weight_that_is_on_it_in_each_stage(cover):
    found = run(STACKED + STAGES, MESHES[cover])
    assert found.summary.status == "converged", found.summary.sentence
    weight = [LOWER + UPPER, LOWER, LOWER + UPPER]
    np.testing.assert_allclose(found.history["reaction:floor:y"], weight, rtol=1e-9)
    # A bar under its own weight and a load on its top: sums of gamma h^2 / 2 E and q h / E.
    settled = -np.array([LOWER / 2 + UPPER, LOWER / 2, LOWER / 2 + UPPER]) / E
    np.testing.assert_allclose(found.history["monitor:top:uy"], settled, rtol=1e-4)
    strain = np.array([1.8, 1 / 15, 1.8])
    np.testing.assert_allclose(found.history["strain_energy"], strain, rtol=1e-4)
    assert abs(found.summary.energy_balance) < 1e-6


def test_stress_before_and_after_is_that_of_the_weight_above():
    found = run(STACKED + STAGES, MESHES["quads"])
    for frame in found.frames[1:]:
        there = found.topologies[frame.topology]
        height = 3.0 if len(set(there.element_region)) == 2 else 1.0
        above = height - there.elements.centroids[:, 1]
        np.testing.assert_allclose(frame.stress[:, 1], -RHO * G * above, rtol=1e-4)


def test_what_leaves_takes_its_energy_and_the_rest_sheds_what_a_slow_removal_would_take():
    found = run(STACKED + STAGES, MESHES["triangles"])
    # Strain of the upper block, the springs of its contact, and F^2 h / 2 E of the lower one.
    taken = 8 / 15 + found.history["contact_energy"][0] + UPPER**2 / (2 * E)
    assert found.history["change_energy"][1] == pytest.approx(-taken, rel=1e-6)
    assert len(found.summary.changes) == 2
    assert found.summary.change_energy == pytest.approx(found.history["change_energy"][-1])


def test_a_block_that_arrives_on_a_loaded_one_carries_its_own_weight_alone():
    push = '[[loads]]\nname = "push"\nkind = "edge"\nsegment = [[0, 1], [1, 1]]\n'
    push += 'block = "lower"\ntraction = [0, -4e4]\n'
    stages = '[[stages]]\nname = "one"\nblocks = ["lower"]\n'
    stages += '[[stages]]\nname = "two"\nadd = ["upper"]\n'
    found = run(STACKED + push + stages, MESHES["quads"])
    assert found.summary.status == "converged", found.summary.sentence
    there = found.topologies[-1]
    upper, above = there.element_region == 1, 3 - there.elements.centroids[:, 1]
    np.testing.assert_allclose(found.stress[upper, 1], -RHO * G * above[upper], rtol=1e-4)
    lower = -4e4 - RHO * G * above[~upper]
    np.testing.assert_allclose(found.stress[~upper, 1], lower, rtol=1e-4)


@pytest.mark.parametrize("first", MESHES)
@pytest.mark.parametrize("change", ["degree", "size"])
def test_contact_goes_on_carrying_the_weight_over_a_change_of_the_cover(first, change):
    cover = MESHES[first]
    if change == "size" and cover["type"] == "block":
        pytest.skip("blocks have no cells")
    other = {"size": 0.3} if change == "size" else {"degree": cover["degree"] + 1}
    keys = ", ".join(f"{key} = {value}" for key, value in other.items())
    stages = '[[stages]]\nname = "one"\n[[stages]]\nname = "two"\ncover = { ' + keys + " }\n"
    found = run(STACKED + stages, cover)
    assert found.summary.status == "converged", found.summary.sentence
    weight = LOWER + UPPER
    np.testing.assert_allclose(found.history["reaction:floor:y"], weight, rtol=1e-6)
    for frame in found.frames[1:]:
        assert frame.contact_force[:, 0].sum() == pytest.approx(-UPPER, rel=1e-6)


def test_a_higher_degree_changes_no_energy_and_a_lower_one_costs_what_is_told():
    table = MESHES["triangles"]
    up = '[[stages]]\nname = "one"\n[[stages]]\nname = "two"\ncover = { degree = 2 }\n'
    raised = run(STACKED + up, table)
    assert abs(raised.history["change_energy"][-1]) < 1e-9 * raised.history["strain_energy"][-1]
    down = up.replace("degree = 2", "degree = 0")
    lowered = run(STACKED + down, table)
    # Constant strains of triangles hold less than the linear ones of a bar under its weight.
    assert lowered.history["strain_energy"][-1] < 0.995 * raised.history["strain_energy"][-1]
    assert abs(lowered.summary.energy_balance) < 1e-6
    told = float(lowered.summary.changes[0].split(", ")[-1].removesuffix(" J"))
    assert abs(told) > 1e-3


BAR = """
plane = "stress"
[materials.steel]
young_modulus = 1e9
poisson_ratio = 0.3
[[blocks]]
name = "bar"
material = "steel"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "wall"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1e6, 0]
[[loads]]
name = "shear"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [0, 2e5]
[[monitors]]
name = "tip"
point = [2, 1]
"""


def test_stages_of_an_elastic_body_superpose():
    cover = {"type": "quads", "size": 0.5, "degree": 1}
    order = ['["pull"]', '["pull", "shear"]', '["shear"]', "[]"]
    stages = "".join(
        f'[[stages]]\nname = "s{n}"\nloads = {names}\n' for n, names in enumerate(order)
    )
    found = run(BAR + stages, cover)
    parts = {}
    for name in ("pull", "shear"):
        other = "shear" if name == "pull" else "pull"
        start = BAR.index(f'[[loads]]\nname = "{other}"')
        alone = run(BAR[:start] + BAR[BAR.index("\n[[", start) :], cover)
        parts[name] = [alone.history[f"monitor:tip:u{axis}"][-1] for axis in "xy"]
    pull, shear = np.array(parts["pull"]), np.array(parts["shear"])
    expected = np.array([pull, pull + shear, shear, 0 * pull])
    tip = np.stack([found.history[f"monitor:tip:u{axis}"] for axis in "xy"], axis=1)
    np.testing.assert_allclose(tip, expected, atol=1e-12 * np.abs(expected).max() * 1e2)


def test_a_support_that_comes_later_holds_the_body_where_it_is():
    cover = {"type": "quads", "size": 0.5, "degree": 1}
    late = '[[supports]]\nname = "right"\npoint = [2, 0]\nfix = ["x", "y"]\n'
    stages = (
        '[[stages]]\nname = "free"\nsupports = ["wall"]\nloads = ["pull"]\n'
        '[[stages]]\nname = "held"\nsupports = ["wall", "right"]\n'
    )
    # Without lateral strain the tension is uniform, and every cover holds it.
    bar = BAR.replace("poisson_ratio = 0.3", "poisson_ratio = 0.0")
    found = run(bar + late + stages, cover)
    tip = found.history["monitor:tip:ux"]
    assert tip[0] == pytest.approx(2e-3, rel=1e-6)
    assert tip[1] == pytest.approx(tip[0], rel=1e-6)
    assert abs(found.history["reaction:right:x"][1]) < 1e-6 * 1e6


FLYING = """
plane = "stress"
[materials.rock]
young_modulus = 1e7
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "body"
material = "rock"
vertices = [[0, 0], [1, 0], [1.2, 0.9], [0.1, 0.8]]
[inertia]
[[initial_velocities]]
block = "body"
velocity = [1, 2]
angular_velocity = 3
[[stages]]
name = "one"
duration = 0.05
[[stages]]
name = "two"
duration = 0.05
cover = { degree = 2 }
"""


HEAD = """
[[supports]]
name = "head"
segment = [[0, 1], [1, 1]]
fix = ["y"]
displacement = [0, 1e-3]
"""
DRIVEN = """
[[stages]]
name = "rest"
supports = ["floor"]
[[stages]]
name = "driven"
supports = ["floor", "head"]
"""
MOVED = 'duration = "1 ms"\n'


@pytest.mark.parametrize(
    ("course", "later"),
    [
        ("", ""),
        ("history = [[0, 1], [9, 1]]\n", ""),
        ("history = [[0, 1], [9, 1]]\n", f'[inertia]\n[[stages]]\nname = "m"\n{MOVED}'),
    ],
    ids=["no history", "history", "clock that stands"],
)
def test_a_support_that_is_new_in_a_stage_is_driven_over_its_increments(course, later):
    one = STACKED.replace("[contact]\n", "").replace("[gravity]\nacceleration = [0, -10]\n", "")
    upper = one[one.index('[[blocks]]\nname = "upper"') : one.index("[interfaces.any]")]
    text = one.replace(upper, "").replace("[interfaces.any]", later.partition("[[")[0])
    text = text.replace('between = "any"\nfriction_angle = 0.5\n', "")
    stages = DRIVEN + "".join(later.partition("[[")[1:])
    found = run(text + HEAD + course + stages, MESHES["quads"], loading={"increment": 0.25})
    history, rest = found.history, 4
    driven = slice(rest, rest + 4)
    share = np.array([0.25, 0.5, 0.75, 1.0])
    # A bar of 1 m by 1 m without Poisson's ratio: E u, and E u^2 / 2 of work.
    np.testing.assert_allclose(history["reaction:head:y"][driven], share * E * 1e-3, rtol=1e-6)
    work = share**2 * E * 1e-3**2 / 2
    np.testing.assert_allclose(history["external_work"][driven], work, rtol=1e-6)
    assert abs(history["change_energy"][rest + 3]) < 1e-9 * work[-1]


def test_a_spinning_body_flies_on_over_a_change_of_degree():
    cover, steps = {"type": "triangles", "size": 0.4, "degree": 1}, {"step": 1e-3}
    found = run(FLYING, cover, integrator={"type": "newmark", **steps})
    state, stepper = found.state, found.stepper
    modes, mass = found.manifold.rigid_modes, stepper.plan.inertia.mass
    total = float(modes[:, 0] @ (mass @ modes[:, 0]))
    moved = state.frames.centre[0] - found.manifold.body_centroid[0]
    np.testing.assert_allclose(moved, 0.1 * np.array([1.0, 2.0]), rtol=1e-10)
    momentum = np.asarray(modes.T @ (mass @ state.velocity))
    turned = state.frames.rotation[0] @ momentum[:2]
    np.testing.assert_allclose(turned, total * np.array([1.0, 2.0]), rtol=1e-10)
    assert abs(found.summary.change_energy) < 1e-9 * found.history["kinetic_energy"][-1]


def test_a_dynamic_stage_follows_one_at_rest_and_the_clock_stands_while_it_comes_to_rest():
    scene = STACKED + "[inertia]\n"
    scene += '[[stages]]\nname = "rest"\n[[stages]]\nname = "still"\nduration = 0.01\n'
    found = run(scene, MESHES["quads"], integrator={"step": 1e-3})
    assert found.summary.status == "converged", found.summary.sentence
    assert found.history["time"][0] == 0.0
    assert found.history["time"][-1] == pytest.approx(0.01)
    # In equilibrium at its start, the column does not move.
    np.testing.assert_allclose(found.history["monitor:top:uy"], -5e-5, rtol=1e-4)


BONDED = """
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
[[blocks]]
name = "base"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[blocks]]
name = "strong"
material = "rock"
vertices = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[blocks]]
name = "weak"
material = "rock"
vertices = [[1, 1], [2, 1], [2, 2], [1, 2]]
[contact]
[interfaces.any]
between = "any"
friction_angle = 0.5
cohesion = 1e5
tensile_strength = 1e5
bonded = true
[[supports]]
name = "floor"
block = "base"
fix = ["x", "y"]
[[supports]]
name = "lift"
block = "weak"
fix = ["x", "y"]
displacement = [0, 0.01]
history = [[0, 0], [1, 1], [2, 1], [3, 1]]
"""


@pytest.mark.parametrize("cover", ['degree = 1, type = "quads", size = 0.5', "degree = 2"])
def test_bonds_that_broke_stay_broken_and_those_that_held_hold(cover):
    stages = f'[[stages]]\nname = "one"\n[[stages]]\nname = "two"\ncover = {{ {cover} }}\n'
    found = run(BONDED + stages, {"type": "block", "functions": "monomials", "degree": 1})
    assert found.summary.status == "converged", found.summary.sentence
    broken, bonded = found.history["broken"], found.history["bonded"]
    assert broken[0] > 0
    assert bonded[0] > 0
    last = found.stepper.plan.contact.record.book
    region = found.manifold.element_region[found.manifold.boundary.element]
    for points, whole in ((last.points, False), (last.lost, True)):
        one, two = (region[edge] for edge in (points.edge_a, points.edge_b))
        weak = (one == 2) | (two == 2)
        assert not points.bonded[weak].any()
        assert whole or points.bonded[~weak].all()


def test_a_stored_run_has_the_topologies_of_its_stages(tmp_path):
    table = nmm.Formulation.model_validate({"cover": MESHES["quads"]})
    found = nmm.run(parse_scene(STACKED + STAGES), table, out=tmp_path / "run")
    stored = read_run(tmp_path / "run")
    assert [len(one.elements) for one in stored.topologies] == [12, 4, 12]
    assert [one.topology for one in stored.frames] == [0, 0, 1, 2]
    for one, other in zip(stored.frames, found.frames, strict=True):
        np.testing.assert_array_equal(one.stress, other.stress)
    assert list(stored.summary.changes) == list(found.summary.changes)


@pytest.mark.parametrize(
    ("stages", "told"),
    [
        ('remove = ["uper"]', "uper"),
        ('remove = ["upper", "lower"]', "no block is left"),
        ('add = ["upper"]', "is there already"),
        ('loads = ["push"]', "push"),
        ('blocks = ["lower"]\nremove = ["upper"]', "one way"),
    ],
)
def test_wrong_stages_are_told_by_their_place(stages, told):
    with pytest.raises(SceneError, match="stages.0") as fault:
        run(STACKED + f'[[stages]]\nname = "one"\n{stages}\n', MESHES["quads"])
    assert told in str(fault.value)


ON_UPPER = """
[[supports]]
name = "wall"
block = "upper"
fix = ["x"]
[[water_pressures]]
name = "uplift"
block = "upper"
level = 2.0
"""
LEAVING = '[[stages]]\nname = "both"\n[[stages]]\nname = "one"\nremove = ["upper"]\n'


@pytest.mark.parametrize("listed", ['supports = ["floor", "wall"]', 'water = ["uplift"]'])
def test_what_a_stage_lists_on_a_block_that_leaves_is_refused_by_line(listed):
    with pytest.raises(SceneError, match=r'stages.1.\w+: ".*is on block "upper", .* not there'):
        run(STACKED + ON_UPPER + LEAVING + listed, MESHES["quads"])


def test_what_is_not_listed_leaves_with_its_block():
    found = run(STACKED + ON_UPPER + LEAVING, MESHES["quads"])
    assert found.history["reaction:floor:y"][-1] == pytest.approx(LOWER, rel=1e-9)


def test_a_bolt_whose_block_leaves_is_refused_with_the_stage():
    bolt = (
        '[[bars]]\nname = "bolt"\npoints = [[0.3, 0.5], [0.3, 2.5]]\narea = 1e-4\n'
        'young_modulus = 2e11\nends = ["fixed", "fixed"]\n'
    )
    with pytest.raises(SceneError, match='"bolt": no block at .* in stage "one"'):
        run(STACKED + bolt + LEAVING, MESHES["quads"])


def test_keys_that_no_cover_has_are_told():
    said = r'cover: sise: unknown key "sise": expected a known key: did you mean "size"\?'
    with pytest.raises((FormulationError, SceneError), match=said):
        run(STACKED + '[[stages]]\nname = "one"\ncover = { sise = 1 }\n', MESHES["quads"])


FLOWING = BAR.replace(
    "poisson_ratio = 0.3",
    'poisson_ratio = 0.3\nlaw = "von_mises"\nyield_stress = 8e5\nhardening_modulus = 1e8',
)


@pytest.mark.parametrize("other", ["degree = 2", "size = 0.3", 'type = "triangles"'])
def test_matter_remembers_how_it_has_flowed_over_a_change_of_the_cover(other):
    # A wall that holds lengthwise, and crosswise at its corner alone, leaves the tension uniform.
    wall = '[[supports]]\nname = "wall"\nsegment = [[0, 0], [0, 1]]\nfix = ["x"]\n'
    pin = '[[supports]]\nname = "pin"\npoint = [0, 0]\nfix = ["y"]\n'
    head, rest = FLOWING[: FLOWING.index("[[supports]]")], FLOWING[FLOWING.index("[[loads]]") :]
    stages = '[[stages]]\nname = "pulled"\nloads = ["pull"]\n'
    stages += f'[[stages]]\nname = "other"\ncover = {{ {other} }}\n'
    stages += '[[stages]]\nname = "let go"\nloads = []\n'
    found = run(head + wall + pin + rest + stages, {"type": "quads", "size": 0.5, "degree": 1})
    assert found.summary.status == "converged", found.summary.sentence
    # 1 MPa over a yield stress of 0.8: (0.2 MPa) / H flows and stays, 1 MPa / E springs back.
    flowed, sprung = 2 * 0.2e6 / 1e8, 2 * 1e6 / 1e9
    expected = [flowed + sprung, flowed + sprung, flowed]
    tip = found.history["monitor:tip:ux"]
    # The spring of the pin gives way by 1e-4 of the bar.
    np.testing.assert_allclose(tip, expected, rtol=1e-3)
    assert tip[1] == pytest.approx(tip[0], rel=3e-4)


@pytest.mark.parametrize("enforcement", ["cone", "barrier", "augmented", "lagrange"])
def test_exact_enforcements_carry_the_weight_over_stages_too(enforcement):
    stages = STAGES + '[[stages]]\nname = "finer"\ncover = { size = 0.4 }\n'
    found = run(STACKED + stages, MESHES["quads"], contact={"enforcement": enforcement})
    assert found.summary.status == "converged", found.summary.sentence
    weight = [LOWER + UPPER, LOWER, LOWER + UPPER, LOWER + UPPER]
    np.testing.assert_allclose(found.history["reaction:floor:y"], weight, rtol=1e-5)
    contact = found.frames[-1].contact_force
    assert contact[:, 0].sum() == pytest.approx(-UPPER, rel=1e-5)


SLOPE = 0.3
INCLINE = f"""
plane = "stress"
[materials.rock]
young_modulus = 1e8
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "ground"
material = "rock"
vertices = [[-1, -0.5], [3, -0.5], [3, 0], [-1, 0]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 0.8], [0, 0.8]]
[gravity]
acceleration = [{10 * np.sin(SLOPE)}, {-10 * np.cos(SLOPE)}]
[inertia]
[contact]
[interfaces.any]
friction_angle = 0.5
[[supports]]
name = "ground"
block = "ground"
fix = ["x", "y"]
[[monitors]]
name = "block"
point = [0.5, 0.8]
[[stages]]
name = "rest"
[[stages]]
name = "before"
duration = 0.02
[[stages]]
name = "after"
duration = 0.02
"""


@pytest.mark.parametrize(
    ("first", "other"),
    [("block", "degree = 2"), ("quads", "size = 0.3"), ("quads", "degree = 2")],
)
def test_a_block_that_friction_holds_in_time_stays_over_a_change_of_the_cover(first, other):
    cover = {"type": "block"} if first == "block" else {"type": "quads", "size": 0.5, "degree": 1}
    if first == "block":
        other += ', functions = "monomials"'
    found = run(INCLINE + f"cover = {{ {other} }}\n", cover, integrator={"step": 5e-4})
    assert found.summary.status == "converged", found.summary.sentence
    weight = 2000 * 0.8 * 10
    for axis, share in ((0, np.cos(SLOPE)), (1, np.sin(SLOPE))):
        forces = [abs(frame.contact_force[:, axis].sum()) for frame in found.frames[1:]]
        carried = [np.mean(forces[:41]), np.mean(forces[41:])]
        # Weight bends a block of degree 2 as it could not bend before: it swings about its rest.
        np.testing.assert_allclose(carried, weight * share, rtol=0.1)
    free = 10 * np.sin(SLOPE) * 0.02**2 / 2
    moved = found.history["monitor:block:ux"]
    assert abs(moved[-1] - moved[0]) < 0.2 * free


def circle(radius, corners):
    """A regular polygon of the area of a circle."""
    angle = np.arange(corners) * 2 * np.pi / corners
    radius *= np.sqrt(2 * np.pi / corners / np.sin(2 * np.pi / corners))
    return (radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)).tolist()


def test_a_tunnel_in_prestressed_ground_closes_by_what_its_excavation_releases():
    inner, outer, modulus, ratio, pressure, corners = 2.0, 5.0, 1e9, 0.25, 5e6, 48
    wall, rim = circle(inner, corners), circle(outer, corners)
    text = f'plane = "strain"\n[materials.rock]\nyoung_modulus = {modulus}\n'
    text += f"poisson_ratio = {ratio}\n[interfaces.any]\nbonded = true\nfriction_angle = 0.5\n"
    text += f'[[blocks]]\nname = "ground"\nmaterial = "rock"\nvertices = {rim}\nholes = [{wall}]\n'
    text += f'[[blocks]]\nname = "core"\nmaterial = "rock"\nvertices = {wall}\n'
    text += f'[[initial_stresses]]\nblock = "all"\nstress = [{-pressure}, {-pressure}, 0]\n'
    text += f'[[monitors]]\nname = "wall"\npoint = {wall[0]}\nblock = "ground"\n'
    for n, ends in enumerate(zip(rim, [*rim[1:], rim[0]], strict=True)):
        text += f'[[supports]]\nname = "s{n}"\nsegment = {[*ends]}\nfix = ["x", "y"]\n'
    text += '[[stages]]\nname = "in place"\n[[stages]]\nname = "tunnel"\nremove = ["core"]\n'
    found = run(text, {"type": "triangles", "size": 0.6, "degree": 1})
    assert found.summary.status == "converged", found.summary.sentence
    # Lame: u = A r + B / r, held at the rim, the wall freed of the pressure.
    shear = modulus / 2 / (1 + ratio)
    lame = 2 * shear * ratio / (1 - 2 * ratio)
    b = -pressure / (2 * (lame + shear) / outer**2 + 2 * shear / inner**2)
    closed = b * (1 / inner - inner / outer**2)
    ways = found.history["monitor:wall:ux"]
    # Polygons of 48 corners for circles; the wall is monitored at one.
    assert ways[1] - ways[0] == pytest.approx(closed, rel=0.015)
    core = np.pi * inner**2 * pressure**2 * (1 + ratio) * (1 - 2 * ratio) / modulus
    released = np.pi * inner * pressure * abs(closed)
    taken = found.history["change_energy"]
    assert taken[1] - taken[0] == pytest.approx(-core - released, rel=0.02)


def test_a_scene_far_away_goes_through_its_stages_as_one_at_the_origin():
    stages = (
        STAGES + '[[stages]]\nname = "graded"\ncover = { type = "graded", options = OPTIONS }\n'
    )
    runs = []
    for x, y in ((0, 0), (2**21, -(2**20))):
        scene = parse_scene((STACKED + stages).replace("OPTIONS", f"{{ focus = [[{x}, {y}]] }}"))
        moved = shifted(scene, np.array([x, y], dtype=float))
        runs.append(nmm.run(moved, nmm.Formulation.model_validate({"cover": MESHES["triangles"]})))
    near, far = runs
    assert [len(one.elements) for one in near.topologies] == [
        len(one.elements) for one in far.topologies
    ]
    for name in ("reaction:floor:y", "monitor:top:uy", "strain_energy"):
        np.testing.assert_allclose(far.history[name], near.history[name], rtol=1e-9)


def test_cells_that_no_memory_holds_are_refused_before_they_are_laid():
    stages = '[[stages]]\nname = "one"\n[[stages]]\nname = "fine"\ncover = { size = 1e-6 }\n'
    with pytest.raises(NmmError, match="cells"):
        run(STACKED + stages, MESHES["quads"])


@pytest.mark.parametrize("order", ["as drawn", "upper first"])
@pytest.mark.parametrize("soft", [1.0, 1e-2])
@pytest.mark.parametrize("cover", ["quads", "triangles"])
def test_a_lift_bonds_to_a_settled_one_in_a_scene_with_contact_as_glue_does(cover, soft, order):
    """The lower one has left the place where the upper is drawn, by up to a millimetre."""
    bond = "friction_angle = 0.5\ncohesion = 1e9\ntensile_strength = 1e9\nbonded = true"
    text = STACKED.replace("friction_angle = 0.5", bond)
    text = text.replace("young_modulus = 1e9", f"young_modulus = {soft * E}")
    if order == "upper first":
        head, lower, upper, tail = *text.split("[[blocks]]"), ""
        upper, mark, tail = upper.partition("[gravity]")
        text = f"{head}[[blocks]]{upper}[[blocks]]{lower}{mark}{tail}"
    text += '[[monitors]]\nname = "crest"\npoint = [0.5, 3]\nblock = "upper"\n'
    text += '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[0, 3], [1, 3]]\n'
    text += f'traction = [0, {3 * UPPER}]\n[[stages]]\nname = "one"\nblocks = ["lower"]\n'
    text += 'loads = []\n[[stages]]\nname = "two"\nadd = ["upper"]\n'
    text += '[[stages]]\nname = "three"\nloads = ["pull"]\n'
    found = run(text, MESHES[cover])
    assert found.summary.status == "converged", found.summary.sentence
    # The upper one settles by its own weight and with what it adds below; then both are pulled.
    settled, pulled = UPPER / E + 2 * UPPER / 2 / E, 3 * 3 * UPPER / E
    expected = np.array([-settled, pulled - settled]) / soft
    np.testing.assert_allclose(found.history["monitor:crest:uy"][1:], expected, rtol=2e-3)
    assert (found.history["bonded"][1:] > 0).all()


@pytest.mark.parametrize("glue", ["spring", "nitsche", "lagrange"])
def test_a_lift_that_is_glued_on_a_settled_one_settles_under_later_loads_alone(glue):
    text = STACKED.replace("[contact]\n", "").replace("friction_angle = 0.5", BOND)
    stages = (
        '[[stages]]\nname = "one"\nblocks = ["lower"]\n[[stages]]\nname = "two"\nadd = ["upper"]\n'
    )
    upper = '[[monitors]]\nname = "crest"\npoint = [0.5, 3]\nblock = "upper"\n'
    found = run(text + upper + stages, MESHES["quads"], glue={"method": glue})
    assert found.summary.status == "converged", found.summary.sentence
    # The lower one under its own weight; then by the upper one, which adds its own shortening.
    first, by_upper, own = LOWER / 2 / E, UPPER / E, 2 * UPPER / 2 / E
    history = found.history
    np.testing.assert_allclose(history["monitor:top:uy"], [-first, -first - by_upper], rtol=1e-3)
    assert history["monitor:crest:uy"][1] == pytest.approx(-by_upper - own, rel=1e-3)


BOND = "friction_angle = 0.5\nbonded = true"
