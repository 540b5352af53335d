"""Rows of bodies of many elements that turn: gaps as places say, work as forces do, no moment."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.assembly.moving.motion import middle, move
from nmm.contact.points.half_way.turning_rows import turning_rows
from nmm.formulation import parse_formulation
from nmm.frozen import with_parts
from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text

COVERS = {
    "triangles": 'type = "triangles"\nsize = 0.4\ndegree = 0',
    "quads": 'type = "quads"\nsize = 0.4\ndegree = 1',
}


def turned(cover, seed=3):
    """Model, sides and points of two squares, and a state before and after a large random step."""
    shapes = text.rectangle((0, 0), (1, 1)), text.rectangle((0.2, 1), (1.1, 1.9))
    tables = [text.material("m", modulus=1e7), text.interface("i", 20.0)]
    tables += [text.block(f"b{k}", "m", shape) for k, shape in enumerate(shapes)]
    head = 'plane = "strain"\nduration = 1e-4\n[gravity]\n[inertia]\n[contact]\n'
    form = parse_formulation(f"[cover]\n{COVERS[cover]}\n[integrator]\nstep = 1e-4\n")
    found = run(parse_scene(text.scene(head, tables)), form)
    contact, model, state = found.stepper.plan.contact, found.stepper.model, found.state
    draws = np.random.default_rng(seed)
    start = with_parts(
        state,
        frames=replace(state.frames, angle=np.array([0.3, -0.2])),
        deformation=1e-2 * draws.normal(size=len(state.deformation)),
    )
    rigid = model.manifold.rigid_modes @ np.array([0.01, 0.02, 0.07, -0.02, 0.01, -0.05])
    increment = rigid + 1e-2 * draws.normal(size=len(rigid))
    return contact, model, start, increment, draws


def rows_of(contact, model, start, increment, forces):
    half = middle(start, move(model, start, increment))
    given = contact.partners.sides, model.rigid_projection, (start, half), forces
    return turning_rows(contact.record.known, *given, contact.geometry.bends)


def test_gaps_change_as_places_of_corners_and_edges_do():
    contact, model, start, increment, _ = turned("triangles")
    points, sides = contact.record.known, contact.partners.sides
    points = points.take(points.parameter_a == 0)
    contact.record = with_parts(contact.record, known=points)
    nothing = np.zeros((2, len(points)))
    rows = rows_of(contact, model, start, increment, tuple(nothing))
    assert len(points) > 1

    def gaps(state):
        surface = sides.surface(state.frames, state.deformation)
        tail, head = surface.start[points.edge_b], surface.end[points.edge_b]
        (x, y), (u, v) = (head - tail).T, (surface.start[points.edge_a] - tail).T
        return (u * y - v * x) / np.hypot(x, y)

    found = rows.normal @ increment + rows.whole.opened[0]
    by_places = gaps(move(model, start, increment)) - gaps(start)
    # Places of 1 m are rounded by 1e-16; the step turns one body by 70 mrad against the other.
    np.testing.assert_allclose(found, by_places, rtol=0, atol=1e-14)


@pytest.mark.parametrize("cover", COVERS)
def test_forces_do_the_work_of_gaps_and_slips_and_push_and_turn_nothing_in_sum(cover):
    contact, model, start, increment, draws = turned(cover)
    forces = tuple(draws.normal(size=(2, len(contact.record.known))))
    rows = rows_of(contact, model, start, increment, forces)
    ways = (
        near @ increment + far
        for near, far in zip((rows.normal, rows.tangent), rows.whole.opened, strict=True)
    )
    work = sum(float(force @ way) for force, way in zip(forces, ways, strict=True))
    push = rows.push(*forces)
    size = np.abs(push).max()
    assert push @ increment == pytest.approx(work, abs=1e-13 * size)
    # Forces in the axes of each body at the start, and moments about the centres half way.
    whole = (model.manifold.rigid_modes.T @ push).reshape(-1, 3)
    pushed = start.frames.to_global(np.arange(2), whole[:, :2])
    assert pushed.sum(axis=0) == pytest.approx([0.0, 0.0], abs=1e-12 * size)
    centre = middle(start, move(model, start, increment)).frames.centre
    turned_by = centre[:, 0] * pushed[:, 1] - centre[:, 1] * pushed[:, 0]
    acting = rows.whole.acting(*forces)
    assert turned_by.sum() + acting.sum() == pytest.approx(0.0, abs=1e-12 * size)
    # Of a body they differ from those of its rows by the third power of its turn.
    assert whole[:, 2] == pytest.approx(acting, abs=0.07**2 / 12 * 2 * size)
