"""The motion of bodies in a step of contact, compiled: `motion.move` to the last digit."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.compiled import compiled
from nmm.frozen import with_parts

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.assembly.state import State

Entries = tuple[npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any]]
"""Values, indices and offsets of a compressed matrix."""


def move(model: "Model", state: "State", increment: Floats) -> "State":
    """Return the state after the step unknowns ``increment``; see `motion.move`."""
    frames = state.frames
    assert frames.way is not None
    places, turns, rest = _moved(
        (frames.centre, frames.way, frames.angle, frames.rotation),
        (increment, state.deformation, state.velocity, state.acceleration),
        entries(model.rigid_projection),
        entries(model.manifold.rigid_modes),
    )
    moved = with_parts(frames, centre=places[0], way=places[1], angle=places[2])
    # What a place keeps besides is made of its angles.
    moved.__dict__.update(rotation=turns[0], turn=turns[1])
    deformation, velocity, acceleration = rest
    parts = {"deformation": deformation, "velocity": velocity, "acceleration": acceleration}
    return with_parts(state, frames=moved, **parts)


def entries(matrix: csr_array | csc_array) -> Entries:
    """Return the arrays of a sparse matrix."""
    return matrix.data, matrix.indices, matrix.indptr


@compiled
def _moved(
    frames: tuple[Floats, Floats, Floats, Floats],
    rates: tuple[Floats, Floats, Floats, Floats],
    projection: Entries,
    modes: Entries,
) -> tuple[tuple[Floats, Floats, Floats], tuple[Floats, Floats], tuple[Floats, Floats, Floats]]:
    """Centres, ways and angles; rotations and turns; deformation, velocity and acceleration.

    ``projection`` are rows (3 B, n), ``modes`` columns (n, 3 B).
    """
    centre, way, angle, rotation = frames
    increment, deformation, velocity, acceleration = rates
    rigid = mean(projection, increment)
    new = centre.copy(), way.copy(), angle.copy()
    turned, less, turn = np.empty_like(rotation), np.empty_like(rotation), np.empty_like(rotation)
    for b in range(len(angle)):
        for i in range(2):
            shift = rotation[b, i, 0] * rigid[3 * b] + rotation[b, i, 1] * rigid[3 * b + 1]
            new[0][b, i] += shift
            new[1][b, i] += shift
        new[2][b] += rigid[3 * b + 2]
        now = new[2][b]
        _rotate(turned[b], np.cos(now), np.sin(now))
        _rotate(less[b], -2 * np.sin(now / 2) ** 2, np.sin(now))
        # The rounded increment of the angle.
        _rotate(turn[b], np.cos(now - angle[b]), np.sin(now - angle[b]))
    whole = deformation + increment - spread(modes, rigid, len(increment))
    rest = (
        whole,
        _kept(projection, modes, velocity, turn),
        _kept(projection, modes, acceleration, turn),
    )
    return new, (turned, less), rest


@compiled
def _rotate(matrix: Floats, along: float, across: float) -> None:
    """Fill a rotation matrix (2, 2)."""
    matrix[0, 0], matrix[0, 1] = along, -across
    matrix[1, 0], matrix[1, 1] = across, along


@compiled
def _kept(projection: Entries, modes: Entries, rate: Floats, turn: Floats) -> Floats:
    """Return a rate (n,) whose mean translation stays fixed in space while axes ``turn``."""
    whole = mean(projection, rate)
    for b in range(len(turn)):
        x, y = whole[3 * b], whole[3 * b + 1]
        for i in range(2):
            whole[3 * b + i] = (turn[b, 0, i] * x + turn[b, 1, i] * y) - (y if i else x)
        whole[3 * b + 2] = 0.0
    found: Floats = rate + spread(modes, whole, len(rate))
    return found


@compiled
def mean(rows: Entries, vector: Floats) -> Floats:
    """Return the products (m,) of rows with a vector."""
    data, indices, offsets = rows
    found = np.zeros(len(offsets) - 1)
    for i in range(len(found)):
        for k in range(offsets[i], offsets[i + 1]):
            found[i] += data[k] * vector[indices[k]]
    return found


@compiled
def spread(columns: Entries, vector: Floats, n: int) -> Floats:
    """Return the product (n,) of columns with a vector."""
    data, indices, offsets = columns
    found = np.zeros(n)
    for i in range(len(vector)):
        for k in range(offsets[i], offsets[i + 1]):
            found[indices[k]] += data[k] * vector[i]
    return found
