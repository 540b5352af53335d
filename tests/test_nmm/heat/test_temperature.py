"""Temperature of scenes: what it does to a run, and what it must leave alone."""

import subprocess
import sys

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing import check_effect_of
from nmm.testing.resumed.stopping import check_goes_on

WALL = """
title = "wall"
plane = "strain"
[materials.m]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2000.0
conductivity = 2.0
heat_capacity = 1000.0
thermal_expansion = 1e-5
[interfaces.j]
friction_angle = 0.5
bonded = true
{joint}
[[blocks]]
name = "a"
material = "m"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[[blocks]]
name = "b"
material = "m"
vertices = [[1, 0], [2, 0], [2, 0.5], [1, 0.5]]
[[supports]]
name = "foot"
segment = [[0, 0], [0, 0.5]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 0.5]]
traction = ["1 MPa", 0]
"""
HOT = """
[[temperatures]]
name = "hot"
segment = [[0, 0], [0, 0.5]]
temperature = {hot}
[[temperatures]]
name = "cold"
segment = [[2, 0], [2, 0.5]]
temperature = 0.0
"""
DAY = 86400
MESH = "[formulation.cover]\ntype = 'triangles'\nsize = 0.37\ndegree = 1\n"
TRANSIENT = """
[heat]
transient = true
duration = "2 days"
[formulation.loading]
increment = 0.1
[formulation.diffusion]
theta = 0.5
"""


def wall(joint="", hot=40.0, heat="[heat]\n", more=""):
    return WALL.format(joint=joint) + heat + HOT.format(hot=hot) + more


def test_no_rise_changes_nothing():
    plain = nmm.run(nmm.parse_scene(WALL.format(joint="") + MESH))
    neutral = nmm.run(nmm.parse_scene(wall(joint="conductance = 3.0", hot=0.0, more=MESH)))
    size = abs(plain.displacement).max()
    # The claim of every neutral effect: less than 1e-12 of the answer.
    assert abs(neutral.displacement - plain.displacement).max() < 1e-12 * size
    assert "heat" in neutral.summary.effect_seconds


def test_a_scene_without_heat_and_water_imports_none_of_it():
    code = (
        "import sys, nmm\n"
        f"nmm.run(nmm.parse_scene('''{WALL.format(joint='')}'''))\n"
        "rooms = ('nmm.heat', 'nmm.diffusion', 'nmm.water', 'covers.scalar')\n"
        "print([m for m in sys.modules if m.startswith(rooms)])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("cover", ["", MESH])
def test_a_joint_lets_through_what_its_conductance_says(cover):
    run = nmm.run(nmm.parse_scene(wall("conductance = 3.0", more=cover)))
    # Resistances in series: 2 m / k + 1 / h, over a face of half a metre.
    flow = 40 / (2 / 2 + 1 / 3) * 0.5
    assert run.history["heat:taken:hot"][-1] == pytest.approx(flow, rel=1e-9)
    assert run.history["heat:taken:cold"][-1] == pytest.approx(-flow, rel=1e-9)


@pytest.mark.parametrize(("crack", "flow"), [("", 0.0), ("conductance = 3.0", 15.0)])
def test_a_crack_through_the_wall_insulates_unless_it_conducts(crack, flow):
    split = (
        '[[cracks]]\nname = "c"\npoints = [[0.613, -0.1], [0.613, 0.6]]\n'
        f"{crack}\n{MESH}[formulation.diffusion]\nstep = 1.0\n"
    )
    glued = wall('conductance = "perfect"', more=split)
    run = nmm.run(nmm.parse_scene(glued))
    # 40 K over 2 m / k + 1 / h, over half a metre; nothing where the crack insulates.
    assert run.history["heat:taken:hot"][-1] == pytest.approx(flow, abs=1e-8)


def test_the_temperature_jumps_across_a_crack_that_stands_in_its_way():
    crack = '[[cracks]]\nname = "c"\npoints = [[0.503, 0.1], [0.503, 0.4]]\n'
    fine = crack + MESH.replace("0.37", "0.05")
    run = nmm.run(nmm.parse_scene(wall('conductance = "perfect"', more=fine)))
    points = run.manifold.elements.points
    heat = run.frames[-1].fields["heat:temperature"].values
    near = (abs(points[:, 0] - 0.503) < 1e-9) & (abs(points[:, 1] - 0.25) < 0.1)
    assert np.ptp(heat[near]) > 1.0
    # A row of slits 2 a in every width W lengthens the way by 2 W / pi ln sec(pi a / W) (Carslaw
    # and Jaeger); six cells along the slit.
    way = 2 + 2 * 0.5 / np.pi * np.log(1 / np.cos(np.pi * 0.15 / 0.5))
    assert run.history["heat:taken:hot"][-1] == pytest.approx(40 / way, rel=1e-3)


def test_transient_heat_is_conserved_and_tends_to_the_steady_one():
    text = wall('conductance = "perfect"', heat=TRANSIENT, more=MESH)
    history = nmm.run(nmm.parse_scene(text)).history
    taken = history["heat:taken:hot"] + history["heat:taken:cold"]
    assert abs(history["heat:stored"] - taken).max() < 1e-10 * history["heat:stored"].max()
    late = nmm.run(nmm.parse_scene(text.replace("2 days", "3000 days")))
    steady = nmm.run(nmm.parse_scene(wall('conductance = "perfect"', more=MESH)))
    # Steps of a hundred diffusion times: Crank and Nicolson's method rings on, damped.
    assert late.displacement == pytest.approx(steady.displacement, abs=2e-2 * 8e-4)


def test_heat_is_followed_over_a_change_of_covers():
    stages = (
        '[[stages]]\nname = "coarse"\n[[stages]]\nname = "fine"\n'
        "cover = { degree = 2, size = 0.3 }\n"
    )
    heat = TRANSIENT.replace("[formulation.loading]\nincrement = 0.1\n", "")
    text = wall('conductance = "perfect"', heat=heat, more=stages + MESH)
    run = nmm.run(nmm.parse_scene(text))
    assert run.summary.status == "converged"
    taken = run.history["heat:taken:hot"] + run.history["heat:taken:cold"]
    # What is carried over has the same heat: the constant field is one of the new functions.
    assert abs(run.history["heat:stored"] - taken).max() < 1e-9 * taken.max()
    assert (np.diff(run.history["heat:stored"]) > 0).all()


@pytest.mark.parametrize("cover", ["", MESH])
def test_heat_keeps_what_every_effect_promises(cover):
    check_effect_of(nmm.parse_scene(wall("conductance = 3.0", more=cover)), "heat")


FAULTS = [
    (wall().replace("[heat]\n", ""), "temperatures.*add .heat."),
    (wall(heat="[heat]\ntransient = true\n"), "heat.transient.*duration missing"),
    (wall(heat='[heat]\nduration = "1 h"\n'), "duration of steady heat"),
    (wall().replace("conductivity = 2.0\n", ""), "materials.m: conductivity missing"),
    (wall(joint="conductance = -3.0"), "conductance: -3.0: expected a conductance"),
    (wall(joint='conductance = "fine"'), "conductance"),
    (wall().replace("segment = [[2, 0], [2, 0.5]]\ntemperature", "temperature"), "no place"),
    (wall().replace("temperature = 40.0", 'temperature = "40 m"'), "converts to K"),
    (wall().replace('name = "cold"', 'name = "hot"'), "a name of its own"),
]


@pytest.mark.parametrize(("text", "said"), FAULTS)
def test_what_contradicts_itself_is_refused_by_line(text, said):
    with pytest.raises(SceneError, match=said):
        nmm.parse_scene(text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (wall(), "block b: nothing holds its temperature"),
        (
            wall("conductance = 1.0").replace("[[2, 0], [2, 0.5]]\ntemp", "[[9, 0], [9, 1]]\ntemp"),
            "segment: .*expected a part of the boundary",
        ),
    ],
)
def test_what_cannot_be_solved_is_refused_by_line_before_it_runs(text, said):
    if "nothing" in said:
        text = text.replace("[[2, 0], [2, 0.5]]\ntemperature", "[[0, 0.5], [1, 0.5]]\ntemperature")
    with pytest.raises(SceneError, match=said):
        nmm.run(nmm.parse_scene(text))


def test_a_run_goes_on_from_a_checkpoint_to_the_same_bytes(tmp_path):
    text = wall('conductance = "perfect"', heat=TRANSIENT, more=MESH)
    # Which solver "auto" takes depends on what the process has imported before.
    text += "[formulation.solver]\ntype = 'superlu'\n[output]\ncheckpoint = { every_steps = 4 }\n"
    whole = check_goes_on(nmm.parse_scene(text), tmp_path)
    assert "heat:temperature" in whole.frames[-1].fields


SQUARE = """
title = "slivers"
plane = "stress"
[materials.m]
young_modulus = "30 GPa"
poisson_ratio = 0.2
conductivity = 2.0
thermal_expansion = 1e-5
[[blocks]]
name = "b"
material = "m"
vertices = [[{x0!r}, {x0!r}], [{x1!r}, {x0!r}], [{x1!r}, {y1!r}], [{x0!r}, {y1!r}]]
[[supports]]
name = "foot"
point = [{x0!r}, {x0!r}]
fix = ["x", "y"]
[[supports]]
name = "top"
point = [{x0!r}, {y1!r}]
fix = ["x"]
[heat]
"""
EDGE = """
[[temperatures]]
name = "edge {i}"
segment = [[{a[0]!r}, {a[1]!r}], [{b[0]!r}, {b[1]!r}]]
temperature = 10
gradient = [7, -4]
about = [{far!r}, {far!r}]
"""


def square(length, far=0.0):
    """A block of 1.5 m and a little by 1 m under a linear temperature."""
    x0, x1, y1 = far, far + length, far + 1.0
    ring = [(x0, x0), (x1, x0), (x1, y1), (x0, y1)]
    edges = [EDGE.format(i=i, a=ring[i], b=ring[(i + 1) % 4], far=far) for i in range(len(ring))]
    return SQUARE.format(x0=x0, x1=x1, y1=y1) + "".join(edges)


@pytest.mark.parametrize("sliver", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12])
@pytest.mark.parametrize("kind", ["triangles", "quads"])
def test_a_linear_temperature_stresses_no_sliver(kind, sliver):
    cover = f"[formulation.cover]\ntype = '{kind}'\nsize = 0.25\ndegree = 1\n"
    run = nmm.run(nmm.parse_scene(square(1.5 + sliver) + cover))
    assert run.summary.status == "converged"
    # The aim is 1e-6 of E alpha T; what is left is rounding of the temperature's 20 K.
    assert abs(run.stress).max() < 1e-10 * 30e9 * 1e-5 * 20


@pytest.mark.parametrize("far", [0.0, 1e5])
def test_a_gradient_is_about_its_point_wherever_the_scene_lies(far):
    run = nmm.run(nmm.parse_scene(square(1.5, far) + MESH))
    heat = run.frames[-1].fields["heat:temperature"].values
    away = run.manifold.elements.points - (
        far if abs(run.manifold.elements.points).max() > 9 else 0
    )
    x, y = (away - away.min(axis=0)).T
    # Coordinates of 1e5 m are rounded to 1e-11 m.
    assert heat == pytest.approx(10 + 7 * x - 4 * y, abs=1e-8)


@pytest.mark.parametrize("cover", ["", MESH])
def test_what_heat_does_is_what_is_stored(cover):
    history = "history = [[0, 0], [1, 1]]\n"
    text = wall("conductance = 3.0", more=cover).replace(
        "temperature = 40.0\n", "temperature = 40.0\n" + history
    )
    text += "[loading]\n[formulation.loading]\nincrement = 0.25\n"
    run = nmm.run(nmm.parse_scene(text))
    assert run.summary.status == "converged"
    assert len(run.history["time"]) == 4
    assert abs(run.summary.energy_balance) < 1e-9


@pytest.mark.parametrize(
    ("heat", "hot", "cold", "told"),
    [
        ("[heat]\n", '"40 degC"', '"10 degC"', "from 0 to 313.15 K, free of strain at 0 K"),
        ('[heat]\nreference = "10 degC"\n', "40.0", '"10 degC"', "from 40 to 283.15 K"),
        ('[heat]\nreference = "10 degC"\n', '"40 degC"', '"-30 degC"', ""),
        ("[heat]\n", "40.0", "-10.0", ""),
        ("[heat]\n", "900.0", "0.0", ""),
    ],
)
def test_degrees_beside_differences_of_temperature_are_told(heat, hot, cold, told):
    """Beside no reference the strain of 40 degrees Celsius is that of 313 K."""
    text = wall(hot=hot, heat=heat).replace("temperature = 0.0", f"temperature = {cold}")
    warned = [one for one in nmm.run(nmm.parse_scene(text)).summary.warnings if "heat: " in one]
    assert len(warned) == bool(told)
    assert told in " ".join(warned)


@pytest.mark.parametrize(
    ("heats", "pulls", "told"),
    [
        (f"[[0, 0], [{2 * DAY}, 1]]", "[[0, 0], [1, 1]]", ""),
        (f"[[0, 0], [{0.2 * DAY}, 1], [{2 * DAY}, 1]]", "[[0, 1], [1e9, 1]]", ""),
        ("[[0, 0], [1, 1]]", "[[0, 0], [1, 1]]", "hot: its history, in s as [heat] duration, ends"),
        ("[[0, 1], [9, 1]]", f"[[0, 0], [{2 * DAY}, 1]]", "pull: its history, in load factors, en"),
    ],
)
def test_histories_by_the_clock_of_another_table_are_told(heats, pulls, told):
    """Two days in ten steps: heat counts seconds, the pull load factors up to 1."""
    text = wall('conductance = "perfect"', heat=TRANSIENT, hot=f"40.0\nhistory = {heats}")
    text = text.replace('traction = ["1 MPa", 0]', f'traction = ["1 MPa", 0]\nhistory = {pulls}')
    warned = [one for one in nmm.run(nmm.parse_scene(text)).summary.warnings if "history" in one]
    assert [one[: len(told)] for one in warned] == [told] * bool(told)


@pytest.mark.parametrize("cover", ["quads", "triangles"])
@pytest.mark.parametrize("angle", [0.0, 0.5, 2.0])
def test_beds_turn_the_flux_away_from_the_slope_of_temperature(cover, angle):
    """A linear temperature held all round: the flux through each edge is that of ``-K grad T``."""
    along, across, slope = 5.0, 1.0, np.array([3.0, 2.0])
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    edges = [np.stack([corners[i - 1], corners[i]]) for i in range(4)]
    held = "".join(
        f'[[temperatures]]\nname = "edge {i}"\nsegment = {edge.tolist()}\ntemperature = 5.0\n'
        f"gradient = {slope.tolist()}\n"
        for i, edge in enumerate(edges)
    )
    scene = (
        'plane = "strain"\n[heat]\n[materials.m]\nlaw = "orthotropic"\nyoung_modulus = 1e9\n'
        "poisson_ratio = 0.2\nyoung_modulus_2 = 1e9\nshear_modulus = 4e8\n"
        f"conductivity = {along}\nconductivity_2 = {across}\naxis_angle = {angle}\n"
        f'[[blocks]]\nname = "b"\nmaterial = "m"\nvertices = {corners.tolist()}\n'
        '[[supports]]\nname = "s"\nblock = "b"\nfix = ["x", "y"]\n'
        f'{held}[formulation.cover]\ntype = "{cover}"\nsize = 0.3\n'
    )
    run = nmm.run(nmm.parse_scene(scene))
    axis = np.array([np.cos(angle), np.sin(angle)])
    tensor = across * np.eye(2) + (along - across) * np.outer(axis, axis)
    for i, (start, end) in enumerate(edges):
        way = end - start
        into = -np.array([way[1], -way[0]])
        found = run.history[f"heat:taken:edge {i}"][-1]
        assert found == pytest.approx(-into @ tensor @ slope, abs=1e-9)
