"""Viscous boundaries and the free field: shear columns, waves that leave, books and drift."""

import tomllib

import numpy as np
import pytest

import nmm
from integration.polygons import Polygons
from nmm.assembly.places import on_segment
from nmm.effects.motion.edge_dashpots import impedances
from nmm.errors import GeometryError, SceneError
from nmm.formulation import Formulation
from nmm.materials.orthotropic import Orthotropic
from nmm.model.from_polygons import solid
from nmm.scene import parse_scene
from nmm.testing import check_effect_of
from nmm.verification.hard.cases.files import toml
from nmm.verification.hard.cases.units import in_units

# Velocity of a wave going up (m/s), every 5 ms: 0.1 sin^2(pi t / 0.2).
TIMES = np.arange(41) * 0.005
PULSE = [float(x) for x in np.round(0.1 * np.sin(np.pi * TIMES / 0.2) ** 2, 12)]
GROUND = """
title = "level ground on rock"
plane = "strain"
duration = {duration}
[materials.soil]
young_modulus = "450 MPa"
poisson_ratio = 0.25
density = 2000
[[blocks]]
name = "soil"
material = "soil"
vertices = [[0, 0], [{width}, 0], [{width}, 30], [0, 30]]
[records.wave]
values = {pulse}
step = 0.005
quantity = "velocity"
[[viscous_boundaries]]
name = "base"
segment = [[0, 0], [{width}, 0]]
incoming = {{ {axis} = "wave" }}
density = 2400
p_velocity = 2400
s_velocity = 1200
[[monitors]]
name = "left"
point = [0, 30]
[[monitors]]
name = "middle"
point = [{middle}, 30]
[inertia]
{more}
[formulation.cover]
type = "quads"
size = 3.0
degree = 0
[formulation.integrator]
type = "newmark"
step = 0.0025
[formulation.rotation]
update = "small"
"""
LEVEL = """
[[supports]]
name = "level"
block = "soil"
fix = ["{held}"]
"""
SIDES = """
[[free_fields]]
name = "left"
segment = [[0, 0], [0, 30]]
base = "base"
[[free_fields]]
name = "right"
segment = [[{width}, 0], [{width}, 30]]
base = "base"
"""


def ground(width=3.0, duration=0.5, more="", axis="x"):
    return GROUND.format(
        width=width,
        middle=width / 2,
        duration=duration,
        pulse=PULSE,
        axis=axis,
        more=more.replace("{width}", str(width)),
    )


def surface(run, monitor="left", axis="x"):
    """Velocity of the surface (m/s) at the middles of steps, and their times."""
    way, time = run.history[f"monitor:{monitor}:u{axis}"], run.history["time"]
    return np.diff(way) / np.diff(time), (time[1:] + time[:-1]) / 2


def series(times, speed=300.0, density=2000.0, below=2400.0 * 1200.0):
    """Velocity of the surface by d'Alembert: what was sent up, reflected and transmitted."""
    own = density * speed
    sent, back = 2 * below / (own + below), (own - below) / (own + below)
    total = np.zeros_like(times)
    for n in range(12):
        since = times - (2 * n + 1) * 30 / speed
        wave = np.where((since > 0) & (since < 0.2), 0.1 * np.sin(np.pi * since / 0.2) ** 2, 0)
        total += 2 * sent * back**n * wave
    return total


def missing(run):
    h = run.history
    lost = sum(column for name, column in h.items() if name.startswith("damping_loss"))
    stored = h["kinetic_energy"] + h["strain_energy"] + h["support_energy"]
    rest = h["external_work"] - stored - lost - h["integration_loss"]
    return np.abs(rest).max() / np.abs(h["external_work"]).max()


def test_a_pulse_in_a_column_on_rock_has_the_closed_surface_motion():
    run = nmm.run(nmm.parse_scene(ground(more=LEVEL.replace("{held}", "y"))))
    velocity, times = surface(run)
    # 2 % at twenty cells a wave (60 m): dispersion of linear elements.
    assert velocity.max() == pytest.approx(0.33103448, rel=0.02)
    assert velocity.min() == pytest.approx(-0.21688466, rel=0.03)
    assert times[np.argmax(velocity)] == pytest.approx(0.2, abs=0.005)
    assert np.abs(velocity - series(times)).max() < 0.03 * 0.33103448
    assert missing(run) < 1e-8


def test_a_pressure_pulse_in_a_column_on_rock_has_the_closed_surface_motion():
    speed = 300 * np.sqrt(3.0)
    scene = ground(more=LEVEL.replace("{held}", "x"), axis="y", duration=0.3)
    run = nmm.run(nmm.parse_scene(scene))
    velocity, times = surface(run, axis="y")
    expected = series(times, speed, below=2400.0 * 2400.0)
    assert np.abs(velocity - expected).max() < 0.03 * expected.max()


def test_a_wave_that_meets_matched_dashpots_straight_on_leaves():
    text = ground(more=LEVEL.replace("{held}", "y"), duration=0.6)
    text = "\n".join(
        line for line in text.splitlines() if not line.startswith(("density = 2400", "p_v", "s_v"))
    )
    run = nmm.run(nmm.parse_scene(text))
    energy = run.history["kinetic_energy"] + run.history["strain_energy"]
    assert energy[-1] < 1e-3 * energy.max()


@pytest.mark.parametrize("axis", ["x", "y"])
def test_every_line_of_a_box_between_free_fields_moves_as_the_column(axis):
    held = "y" if axis == "x" else "x"
    column = nmm.run(nmm.parse_scene(ground(more=LEVEL.replace("{held}", held), axis=axis)))
    box = nmm.run(nmm.parse_scene(ground(width=60.0, more=SIDES, axis=axis)))
    expected, _ = surface(column, axis=axis)
    for monitor in ("left", "middle"):
        found, _ = surface(box, monitor, axis)
        assert np.abs(found - expected).max() < 1e-3 * np.abs(expected).max()
        other = box.history[f"monitor:{monitor}:u{held}"]
        along = box.history[f"monitor:{monitor}:u{axis}"]
        assert np.abs(other).max() < 1e-4 * np.abs(along).max()
    assert missing(box) < 1e-8


def test_ground_between_free_fields_moves_alike_in_millimetres():
    """Points in the middle of cells lie on nodes of the columns: rounding chose the element."""
    scene = tomllib.loads(ground(duration=0.02, more=SIDES).replace("30]", "3]"))
    scene["formulation"]["cover"] = {"type": "quads", "size": 1.4531, "degree": 2}
    plain, scaled = (nmm.run(parse_scene(toml(one))) for one in (scene, in_units(scene, 1e3, 1.0)))
    for name in ("monitor:left:ux", "monitor:middle:ux"):
        way = plain.history[name]
        # Rounding of the solutions, of 8 steps.
        assert np.abs(scaled.history[name] / 1e3 - way).max() < 1e-9 * np.abs(way).max()


def test_what_shis_rule_takes_of_a_wave_is_told():
    """Peaks of matched ground are twice the wave; with steps of 2.5 ms they are 3 % short."""
    text = ground(more=LEVEL.replace("{held}", "y"), duration=0.4)
    ours = [s for s in text.splitlines() if not s.startswith(("density = 2400", "p_v", "s_v"))]
    kept, lossy = (
        nmm.run(nmm.parse_scene("\n".join(ours).replace('"newmark"', rule)))
        for rule in ('"newmark"', '"shi"')
    )
    assert surface(kept)[0].max() == pytest.approx(0.2, rel=1e-3)
    assert not kept.summary.warnings
    short = 1 - surface(lossy)[0].max() / 0.2
    assert lossy.summary.audits["record_damped"] == pytest.approx(short, rel=0.3)
    assert any("record_damped" in one for one in lossy.summary.warnings)


RIDING = """
[[supports]]
name = "rock"
segment = [[0, 0], [{width}, 0]]
fix = ["x", "y"]
motion = { x = "wave" }
[damping]
mass = 8.0
stiffness = 0.001
ground = "rock"
"""


def test_free_fields_damp_against_the_ground_that_the_model_damps_against():
    """Columns that damped against axes at rest drove the edges 17 % off."""

    def shaken(width, more):
        text = ground(width=width, more=RIDING.replace("{width}", str(width)) + more)
        start, end = text.index("[[viscous"), text.index("[[monitors]]")
        return nmm.run(nmm.parse_scene(text[:start] + text[end:]))

    column = shaken(3.0, LEVEL.replace("{held}", "y"))
    sides = SIDES.replace("{width}", "60.0").replace('base = "base"', 'base = "rock"')
    box, expected = shaken(60.0, sides), surface(column)[0]
    for monitor in ("left", "middle"):
        assert np.abs(surface(box, monitor)[0] - expected).max() < 1e-3 * np.abs(expected).max()


LAYERED = 'law = "orthotropic"\nyoung_modulus_2 = "1.8 GPa"\nshear_modulus = "180 MPa"\n'


@pytest.mark.parametrize("axis", ["x", "y"])
def test_waves_leave_layered_ground_and_free_fields_move_as_it_does(axis):
    """Upright stiffness is 3.2 times the level one, which stood for both before."""
    held = "y" if axis == "x" else "x"
    text = ground(more=LEVEL.replace("{held}", held), axis=axis, duration=0.3)
    text = text.replace('"450 MPa"\n', '"450 MPa"\n' + LAYERED)
    ours = [s for s in text.splitlines() if not s.startswith(("density = 2400", "p_v", "s_v"))]
    velocity, times = surface(nmm.run(nmm.parse_scene("\n".join(ours))), axis=axis)
    speed = np.sqrt({"x": 180e6, "y": 4.32e9}[axis] / 2000)
    since = times - 30 / speed
    # Nothing comes back from below: the free surface moves by twice the wave.
    wave = np.where((since > 0) & (since < 0.2), 0.2 * np.sin(np.pi * since / 0.2) ** 2, 0.0)
    assert np.abs(velocity - wave).max() < 0.02 * 0.2
    box = ground(width=30.0, more=SIDES, axis=axis, duration=0.3)
    box = nmm.run(nmm.parse_scene(box.replace('"450 MPa"\n', '"450 MPa"\n' + LAYERED)))
    moved, middle = (surface(box, name, axis)[0] for name in ("left", "middle"))
    assert np.abs(moved - middle).max() < 1e-3 * np.abs(middle).max()


def test_impedances_of_matter_whose_axes_lean_are_those_of_its_own_axes():
    """An edge along axis 1 of the matter, level and turned by 0.5 rad."""
    found = []
    for angle in (0.0, 0.5):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        laws = [Orthotropic(450e6, 0.25, 1.8e9, 180e6, angle)]
        square = np.array([[0, 0], [3, 0], [3, 3], [0, 3]]) @ turn.T
        cover = Formulation().cover
        model = solid(Polygons.from_vertices([square]), cover, laws, "strain", density=[2000.0])
        place = on_segment(model.manifold, np.array([[0.0, 0.0], 3 * turn[:, 0]]))
        found.append(turn.T @ impedances(model, place)[0] @ turn)
    np.testing.assert_allclose(found[1], found[0], rtol=1e-12, atol=1e-6)
    own = Orthotropic(450e6, 0.25, 1.8e9, 180e6).stiffness("strain")
    expected = np.diag(np.sqrt(2000 * np.array([180e6, own[1, 1]])))
    np.testing.assert_allclose(found[0], expected, rtol=1e-12, atol=1e-6)


def test_a_floating_base_drifts_by_traction_over_impedance():
    load = """
[[loads]]
name = "wind"
kind = "edge"
segment = [[0, 30], [3, 30]]
traction = [6e3, 0]
[damping]
mass = 0.0
stiffness = 0.05
"""
    text = ground(more=LEVEL.replace("{held}", "y") + load, duration=2.0)
    text = text.replace("incoming", "#").replace("step = 0.0025", "step = 0.01")
    run = nmm.run(nmm.parse_scene(text))
    drift = run.history["viscous boundaries:base:ux"]
    speed = (drift[-1] - drift[-21]) / 0.2
    assert speed == pytest.approx(6e3 / (2400 * 1200), rel=1e-3)


@pytest.mark.parametrize("cover", ["block", "triangles"])
@pytest.mark.parametrize("effect", ["viscous boundaries", "free fields"])
def test_boundaries_keep_what_every_effect_promises(effect, cover):
    text = ground(width=6.0, more=SIDES)
    chosen = 'type = "block"' if cover == "block" else 'type = "triangles"\nsize = 6.0'
    text = text.replace('type = "quads"\nsize = 3.0\ndegree = 0', chosen)
    check_effect_of(nmm.parse_scene(text), effect)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"wave" }', '"wav" }', 'viscous_boundaries.0.incoming.x: "wav"'),
        ("s_velocity = 1200", "", "a part of the ground beyond"),
        ("p_velocity = 2400", "p_velocity = 100", "p_velocity above s_velocity"),
        ('base = "base"', 'base = "bas"', 'free_fields.0.base: "bas"'),
        ("[[0, 0], [0, 30]]", "[[0, 0], [1, 30]]", "a vertical segment"),
        ("[inertia]", "", "no [inertia]: expected a dynamic scene"),
    ],
)
def test_wrong_boundaries_are_told_by_line(old, new, said):
    text = ground(more=SIDES)
    assert old in text
    with pytest.raises(SceneError) as caught:
        nmm.parse_scene(text.replace(old, new, 1), "s.toml")
    assert said in str(caught.value)
    assert "s.toml:" in str(caught.value)


def test_a_boundary_off_the_material_is_refused_with_its_line_and_place():
    text = ground().replace("segment = [[0, 0], [3.0, 0]]", "segment = [[0, 1], [3.0, 1]]")
    told = (
        r'^scene:17: viscous_boundaries\.0: "base": \[\[0\.0, 1\.0\], \[3\.0, 1\.0\]\]: expected '
    )
    with pytest.raises(GeometryError, match=told):
        nmm.run(nmm.parse_scene(text))
