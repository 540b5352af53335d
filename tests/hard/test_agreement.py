"""Summary, history, frames and ParaView files of a run say the same, and fit one another.

Random small scenes of blocks, in time and under loads, to failure and stopped early. What can be
had from another part of the output is computed from it anew: energies from the velocities and
stresses of a frame, counts and penetration from its contact points, displacements of monitors from
its vertices.
"""

import base64
import json
import random
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
import tomli_w

import nmm
from nmm.results.viewing.cells import cells
from nmm.results.viewing.paraview import output_times, write_paraview

SEEDS = [*range(6), *(pytest.param(n, marks=pytest.mark.slow) for n in range(6, 60))]

YOUNG, POISSON, DENSITY = 1e8, 0.2, 2500.0


def document(seed):
    """Tables of a random scene: three blocks on a floor, thrown, or pushed until they slide."""
    draw = random.Random(seed)
    far = draw.choice([0.0, 0.0, 3e5])
    kind = ("time", "loads", "bonded")[seed % 3]
    interface = {"friction_angle": f"{draw.uniform(5, 40)} deg"}
    if kind == "bonded":
        interface |= {"bonded": True, "cohesion": 2e4, "tensile_strength": 1e4}
    gap = draw.uniform(1e-4, 2e-3) if kind == "time" else 0.0
    blocks = [("floor", -1.0, -1.0, 5.0, 1.0)]
    for number in range(3):
        x, width = 1.2 * number, draw.uniform(0.6, 1.1)
        blocks.append((f"block {number}", x, gap, width, draw.uniform(0.5, 1.2)))
    scene = {
        "title": f"agreement {seed}",
        "plane": "strain",
        "thickness": draw.choice([1.0, 0.3]),
        "gravity": {},
        "contact": {},
        "materials": {
            "rock": {"young_modulus": YOUNG, "poisson_ratio": POISSON, "density": DENSITY}
        },
        "interfaces": {"any": interface},
        "blocks": [
            {"name": name, "material": "rock", "vertices": _box(x + far, y, w, h)}
            for name, x, y, w, h in blocks
        ],
        "supports": [{"name": "held", "block": "floor", "fix": ["x", "y"]}],
        "monitors": [
            {"name": f"m{n}", "point": [x + w + far, y + h], "block": name}
            for n, (name, x, y, w, h) in enumerate(blocks[1:])
        ],
        "formulation": {"contact": {"enforcement": draw.choice(["penalty", "augmented"])}},
    }
    if kind == "time":
        scene |= {"inertia": {}, "duration": 0.06}
        scene["initial_velocities"] = [
            {"block": "block 1", "velocity": [draw.uniform(-2, 2), draw.uniform(0, 1)]},
            {"block": "block 2", "angular_velocity": draw.uniform(-1, 1)},
        ]
        method = draw.choice(["shi", "newmark", "generalized_alpha"])
        scene["formulation"]["integrator"] = {"step": 1e-3, "type": method}
    else:
        point = [far, gap + 0.2]
        push = {"name": "push", "kind": "point", "point": point, "block": "block 0"}
        scene["loads"] = [push | {"force": [2e4 if kind == "loads" else 8e4, 0.0]}]
        scene["loading"] = {"until": "failure", "scaled": ["push"], "motion_after_failure": 0.01}
        scene["formulation"]["loading"] = {"increment": 0.13}
        scene["formulation"]["integrator"] = {"step": 1e-3}
    stored = [{}, {"every_steps": 3}, {"events": ["state_changes", "first_contact"]}]
    scene["output"] = draw.choice(stored)
    return scene, draw


def _box(x, y, width, height):
    return [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]


class Stopped(Exception):
    """What stops a run here."""


def made(seed, tmp_path):
    """A run of a random scene, whole or stopped by its progress, as stored; and in memory."""
    tables, draw = document(seed)
    path = tmp_path / "scene.toml"
    path.write_text(tomli_w.dumps(tables))
    stop = draw.choice([None, None, draw.randrange(2, 9)])
    calls = iter(range(10**9))

    def progress(share, text):
        if stop is not None and next(calls) >= stop:
            raise Stopped(f"after {stop}")

    if stop is None:
        memory = nmm.run(nmm.read_scene(path), out=tmp_path / "run")
    else:
        memory = None
        with pytest.raises(Stopped):
            nmm.run(nmm.read_scene(path), out=tmp_path / "run", progress=progress)
    return tables, memory, nmm.read_run(tmp_path / "run"), stop


def energies(frame, topology, thickness):
    """Kinetic and strain energy of blocks whose velocity is linear and whose stress is constant."""
    kinetic = strain = 0.0
    start = topology.elements.ring_offsets
    for element, (first, end) in enumerate(pairwise(start)):
        place, velocity = frame.points[first:end], frame.velocity[first:end]
        laid = place - frame.displacement[first:end]
        ones = np.ones_like(laid)
        area = _integral(laid, ones, ones) / 2
        moving = _integral(laid, velocity, velocity) / 2 - _coupled(laid, place, velocity)
        kinetic += DENSITY * thickness * moving
        xx, yy, xy = frame.stress[element]
        c = (1 + POISSON) / YOUNG
        density = c * ((1 - POISSON) * (xx**2 + yy**2) - 2 * POISSON * xx * yy + 2 * xy**2) / 2
        strain += thickness * area * density
    return kinetic, strain


def _coupled(laid, place, velocity):
    """Energy of a block's spin with the moment of momentum of its vibration, over its density.

    That is ``omega int u x du/dt`` in axes in which it does not turn on average, and is not in the
    energy of the spin, which is momentum over moment of inertia (docs/motion.md, docs/limits.md).
    """
    area = _integral(laid, np.ones_like(laid), np.ones_like(laid)) / 2
    arm, place, velocity = (
        points - [_integral(laid, points, np.full_like(laid, side)) / area for side in np.eye(2)]
        for points in (laid, place, velocity)
    )
    angle = np.arctan2(_integral(laid, _turned(arm), place), _integral(laid, arm, place))
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    place, velocity = place @ turn, velocity @ turn
    spin = _integral(laid, _turned(arm), velocity) / _integral(laid, arm, place)
    return spin * _integral(laid, _turned(place - arm), velocity - spin * _turned(place))


def _turned(vectors):
    """Vectors (m, 2) turned by a quarter, counterclockwise."""
    return np.stack([-vectors[:, 1], vectors[:, 0]], axis=1)


def _integral(laid, one, other):
    """Integral of the scalar product of two linear fields (m, 2), by their values at corners."""
    found = 0.0
    for n in range(1, len(laid) - 1):  # a fan of triangles
        a, b = laid[n] - laid[0], laid[n + 1] - laid[0]
        area = abs(a[0] * b[1] - a[1] * b[0]) / 2
        f, g = one[[0, n, n + 1]], other[[0, n, n + 1]]
        # A/12 (sum f . sum g + sum f . g) over a triangle, exact
        found += area / 12 * (f.sum(axis=0) @ g.sum(axis=0) + np.sum(f * g))
    return found


@pytest.mark.parametrize("seed", SEEDS)
def test_summary_history_frames_and_paraview_agree(tmp_path, seed):
    tables, memory, stored, stop = made(seed, tmp_path)
    history, summary = stored.history, stored.summary
    raw = json.loads((tmp_path / "run/summary.json").read_text())
    assert (raw["status"], raw["steps"]) == (summary.status, summary.steps)
    assert stored.faults == ()
    rows = len(history["step"])
    assert np.array_equal(history["step"], np.arange(1, rows + 1))
    assert summary.steps == rows
    if stop is None:
        _same_as_memory(stored, memory)
        assert summary.frames == len(stored.frames)
        assert summary.passes == history["passes"].sum()
        assert summary.equilibrium_residual == history["residual"].max()
        assert summary.largest_penetration == max(np.nanmax(history["penetration"]), 0.0)
        for name, count in summary.largest_contacts.items():
            assert count == np.nanmax(history[name]), name
    else:
        assert summary.status == "stopped"
        assert f"Stopped: after {stop}" in summary.sentence
    if summary.status == "failure_load":
        assert summary.failure_factor == history["load_factor"][-1]
    _frames_fit(stored, tables, stop)
    _paraview_fits(stored, tmp_path)


def _same_as_memory(stored, memory):
    assert stored.summary == memory.summary
    assert list(stored.history) == list(memory.history)
    for name, column in memory.history.items():
        assert np.array_equal(column, stored.history[name], equal_nan=True)
    for one, other in zip(memory.frames, stored.frames, strict=True):
        held, read = vars(one).copy(), vars(other).copy()
        fields, others = held.pop("fields"), read.pop("fields")
        for name, value in held.items():
            assert np.array_equal(value, read[name]), name
        assert list(fields) == list(others)
        for name, quantity in fields.items():
            assert (quantity.on, quantity.unit) == (others[name].on, others[name].unit)
            assert np.array_equal(quantity.values, others[name].values), name


def _frames_fit(stored, tables, stop):
    """Each frame but the first and those after failure is a row of the history."""
    history, topology = stored.history, stored.topologies[0]
    clock = "time" if "inertia" in tables else "load_factor"
    frames = [frame for frame in stored.frames if frame.stage != "failure"]
    assert [frame.index for frame in stored.frames] == list(range(len(stored.frames)))
    if stop is None:
        assert getattr(frames[-1], clock) == history[clock][-1]
    for frame in frames[1:]:
        (row,) = np.flatnonzero(history[clock] == getattr(frame, clock))
        for name, state in (("open", 0), ("stick", 1), ("slide", 2), ("bonded", 3)):
            assert np.sum(frame.contact_state == state) == history[name][row], name
        assert max(-frame.contact_gap.min(initial=0.0), 0.0) == history["penetration"][row]
        kinetic, strain = energies(frame, topology, tables["thickness"])
        # Sums in another order, and the spin's energy to first order in strains of 1e-3; 3e5 m from
        # the origin vertices are rounded to 6e-11 m.
        assert kinetic == pytest.approx(history["kinetic_energy"][row], rel=1e-6, abs=1e-9)
        assert strain == pytest.approx(history["strain_energy"][row], rel=1e-6, abs=1e-9)
        for number, monitor in enumerate(tables["monitors"]):
            block = topology.region_names.index(monitor["block"])
            mine = np.flatnonzero(
                topology.element_region[topology.elements.polygon_of_point] == block
            )
            away = np.abs(topology.elements.points[mine] - monitor["point"]).sum(axis=1)
            way = frame.displacement[mine[np.argmin(away)]]
            said = [history[f"monitor:m{number}:{name}"][row] for name in ("ux", "uy")]
            assert way == pytest.approx(np.array(said), rel=1e-9, abs=3e-10)


def _paraview_fits(stored, folder):
    opened = write_paraview(stored, folder / "paraview")
    topology = stored.topologies[0]
    order = cells(topology.elements).polygon
    for path in opened:
        entries = list(ElementTree.parse(path).iter("DataSet"))
        times = [frame.time for frame in stored.frames]
        assert [float(entry.get("timestep")) for entry in entries] == output_times(times)
        if all(b > a for a, b in pairwise(times)):
            assert [float(entry.get("timestep")) for entry in entries] == times
        for entry, frame in zip(entries, stored.frames, strict=True):
            read = _arrays(path.parent / entry.get("file"))
            if path.name == "blocks.pvd":
                before = frame.points - frame.displacement
                assert np.array_equal(read["Points"][:, :2], before)
                assert np.array_equal(read["displacement"][:, :2], frame.displacement)
                assert np.array_equal(read["velocity"][:, :2], frame.velocity)
                assert np.array_equal(read["stress"], frame.stress[order])
            else:
                assert np.array_equal(read["Points"][:, :2], frame.contact_position)
                assert np.array_equal(read["gap"], frame.contact_gap)
                assert np.array_equal(read["state"], frame.contact_state)
                assert np.array_equal(read["normal_force"], frame.contact_force[:, 0])
                size = np.hypot(*frame.contact_force.T)
                found = np.linalg.norm(read["force"], axis=1)
                assert found == pytest.approx(size, rel=1e-12, abs=1e-12 * size.max(initial=0.0))


def _arrays(path):
    """Arrays of a .vtu by name, by the XML alone."""
    found = {}
    for item in ElementTree.parse(path).iter("DataArray"):
        raw = base64.b64decode(item.text)
        kind = {"Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}[item.get("type")]
        width = int(item.get("NumberOfComponents"))
        values = np.frombuffer(raw[8:], kind)
        found[item.get("Name")] = values.reshape(-1, width) if width > 1 else values
    return found
