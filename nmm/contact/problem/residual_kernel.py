"""The out-of-balance force of cut springs in one compiled pass over matrix and contacts.

`CutSprings.forces` and `StepProblem.out_of_balance` say the same in whole arrays and are what this
is tested against.
"""

from typing import NamedTuple

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled, place
from nmm.contact.problem.row_products import Compressed
from nmm.solvers.kernels.scaling_kernel import diagonal


@compiled
def projected(
    normal: float, shear: float, tension: float, cohesion: float, friction: float
) -> tuple[float, float]:
    """`nmm.contact.problem.coulomb.project` of one contact."""
    bound = cohesion
    if normal > tension:
        if tension <= 0.0:
            bound = 0.0
        normal = tension
    if normal < 0.0:
        bound -= friction * normal
    return normal, min(max(shear, -bound), bound)


class SpringColumns(NamedTuple):
    """Cut springs as compiled code takes them, see `CutSprings`.

    Attributes
    ----------
    load, weight
        (n,) force of the step and weights of what is out of balance.
    matrix
        Compressed columns, of a symmetric one rows as well.
    normal_rows, tangent_rows
        Compressed rows of gaps and slips.
    gap, slip
        (m,) of the contacts.
    stiffness, shift
        (2, m) of normal and shear springs.
    tension, cohesion, friction
        (m,) limits.
    least
        What forces count as at least.
    paired
        Whether both rows hold the same unknowns, entry by entry.
    """

    load: Floats
    weight: Floats
    matrix: Compressed
    normal_rows: Compressed
    tangent_rows: Compressed
    gap: Floats
    slip: Floats
    stiffness: Floats
    shift: Floats
    tension: Floats
    cohesion: Floats
    friction: Floats
    least: float
    paired: bool


@compiled
def residual(increment: Floats, springs: SpringColumns) -> tuple[Floats, float]:
    """Out-of-balance force (n,) and its size over the largest of its parts, or over ``least``.

    The matrix is symmetric: its compressed columns serve as rows.
    """
    load, weight, least = springs.load, springs.weight, springs.least
    pointers, columns, entries = springs.matrix
    contact, n = _contact_forces(increment, springs), len(increment)
    force = np.empty(n)
    inner_size, contact_size, load_size, rest_size = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        inner = 0.0
        for k in range(place(pointers[i]), place(pointers[i + 1])):
            inner += entries[k] * increment[place(columns[k])]
        force[i] = inner + contact[i] - load[i]
        inner_size += (weight[i] * inner) ** 2
        contact_size += (weight[i] * contact[i]) ** 2
        load_size += (weight[i] * load[i]) ** 2
        rest_size += (weight[i] * force[i]) ** 2
    largest = max(inner_size, contact_size, load_size, least**2)
    return force, np.sqrt(rest_size / largest) if largest > 0.0 else 0.0


@compiled
def _contact_forces(increment: Floats, springs: SpringColumns) -> Floats:
    """Forces of all springs on the unknowns (n,).

    Where normal and tangent rows are ``paired``, entry by entry of the same unknowns, a contact is
    read once.
    """
    normal_pointers, normal_columns, normal_entries = springs.normal_rows
    tangent_pointers, tangent_columns, tangent_entries = springs.tangent_rows
    stiffness, shift = springs.stiffness, springs.shift
    tension, cohesion, friction = springs.tension, springs.cohesion, springs.friction
    gap, slip, paired = springs.gap, springs.slip, springs.paired
    contact = np.zeros(len(increment))
    for c in range(len(gap)):
        opening, sliding = gap[c], slip[c]
        if paired:
            for k in range(place(normal_pointers[c]), place(normal_pointers[c + 1])):
                moved = increment[place(normal_columns[k])]
                opening += normal_entries[k] * moved
                sliding += tangent_entries[k] * moved
        else:
            for k in range(place(normal_pointers[c]), place(normal_pointers[c + 1])):
                opening += normal_entries[k] * increment[place(normal_columns[k])]
            for k in range(place(tangent_pointers[c]), place(tangent_pointers[c + 1])):
                sliding += tangent_entries[k] * increment[place(tangent_columns[k])]
        normal = stiffness[0, c] * opening + shift[0, c]
        shear = stiffness[1, c] * sliding + shift[1, c]
        normal, shear = projected(normal, shear, tension[c], cohesion[c], friction[c])
        if paired and (normal != 0.0 or shear != 0.0):
            for k in range(place(normal_pointers[c]), place(normal_pointers[c + 1])):
                push = normal_entries[k] * normal + tangent_entries[k] * shear
                contact[place(normal_columns[k])] += push
        if normal != 0.0 and not paired:
            for k in range(place(normal_pointers[c]), place(normal_pointers[c + 1])):
                contact[place(normal_columns[k])] += normal_entries[k] * normal
        if shear != 0.0 and not paired:
            for k in range(place(tangent_pointers[c]), place(tangent_pointers[c + 1])):
                contact[place(tangent_columns[k])] += tangent_entries[k] * shear
    return contact


@compiled
def weighted(
    matrix: Compressed,
    normal_rows: Compressed,
    tangent_rows: Compressed,
    stiffness: Floats,
) -> Floats:
    """Inverse roots (n,) of the diagonal of matrix and springs; 1 where that is not positive."""
    normal_pointers, normal_columns, normal_entries = normal_rows
    tangent_pointers, tangent_columns, tangent_entries = tangent_rows
    found = diagonal(*matrix)
    for c in range(stiffness.shape[1]):
        for k in range(place(normal_pointers[c]), place(normal_pointers[c + 1])):
            found[place(normal_columns[k])] += normal_entries[k] ** 2 * stiffness[0, c]
    for c in range(stiffness.shape[1]):
        for k in range(place(tangent_pointers[c]), place(tangent_pointers[c + 1])):
            found[place(tangent_columns[k])] += tangent_entries[k] ** 2 * stiffness[1, c]
    for j in range(len(found)):
        found[j] = 1.0 / np.sqrt(found[j]) if found[j] > 0.0 else 1.0
    return found


@compiled
def unevenness(
    increment: Floats,
    load: Floats,
    weight: Floats,
    forces: tuple[Floats, Floats],
    matrix: Compressed,
    rows: tuple[Compressed, Compressed],
    body: Ints,
    floor: float,
) -> float:
    """Largest out-of-balance force of an unknown over the largest part of one of its body.

    Of given normal and shear ``forces`` (m,) through both ``rows``. All is weighted; what is below
    the share ``floor`` of the length of all parts does not count. A contact counts in the parts
    with both its forces through either row.
    """
    rest, whole = -load, np.abs(load)
    pointers, numbers, entries = matrix
    for j in range(len(increment)):
        for k in range(place(pointers[j]), place(pointers[j + 1])):
            part = entries[k] * increment[j]
            rest[place(numbers[k])] += part
            whole[place(numbers[k])] += abs(part)
    pressed = np.abs(forces[0]) + np.abs(forces[1])
    _add_forces(rows[0], forces[0], pressed, rest, whole)
    _add_forces(rows[1], forces[1], pressed, rest, whole)
    last, square = -1, 0.0
    for i in range(len(rest)):
        rest[i], whole[i] = weight[i] * abs(rest[i]), weight[i] * whole[i]
        square += whole[i] ** 2
        last = max(last, body[i])
    largest = np.zeros(last + 1)
    for i in range(len(rest)):
        largest[body[i]] = max(largest[body[i]], whole[i])
    found, least = 0.0, floor * np.sqrt(square)
    for i in range(len(rest)):
        if rest[i] > least:
            found = max(found, rest[i] / largest[body[i]])
    return found


@compiled
def _add_forces(
    rows: Compressed, force: Floats, pressed: Floats, rest: Floats, whole: Floats
) -> None:
    """Add forces (m,) through rows to ``rest`` (n,), and what is ``pressed`` by size to another."""
    pointers, columns, entries = rows
    for c in range(len(force)):
        for k in range(place(pointers[c]), place(pointers[c + 1])):
            rest[place(columns[k])] += entries[k] * force[c]
            whole[place(columns[k])] += abs(entries[k]) * pressed[c]
