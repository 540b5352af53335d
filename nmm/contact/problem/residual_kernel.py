"""The out-of-balance force of cut springs in one compiled pass over matrix and contacts.

`CutSprings.forces` and `StepProblem.out_of_balance` say the same in whole arrays and are what this
is tested against.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats
from nmm.compiled import compiled

Index = npt.NDArray[Any]


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


@compiled
def residual(
    increment: Floats,
    load: Floats,
    weight: Floats,
    pointers: Index,
    columns: Index,
    entries: Floats,
    normal_pointers: Index,
    normal_columns: Index,
    normal_entries: Floats,
    tangent_pointers: Index,
    tangent_columns: Index,
    tangent_entries: Floats,
    gap: Floats,
    slip: Floats,
    normal_stiffness: Floats,
    shear_stiffness: Floats,
    normal_shift: Floats,
    shear_shift: Floats,
    tension: Floats,
    cohesion: Floats,
    friction: Floats,
) -> tuple[Floats, float]:
    """Out-of-balance force (n,) and its size over the largest of its parts.

    The matrix is symmetric: its compressed columns serve as rows.
    """
    n = len(increment)
    contact = np.zeros(n)
    for c in range(len(gap)):
        opening, sliding = gap[c], slip[c]
        for k in range(normal_pointers[c], normal_pointers[c + 1]):
            opening += normal_entries[k] * increment[normal_columns[k]]
        for k in range(tangent_pointers[c], tangent_pointers[c + 1]):
            sliding += tangent_entries[k] * increment[tangent_columns[k]]
        normal = normal_stiffness[c] * opening + normal_shift[c]
        shear = shear_stiffness[c] * sliding + shear_shift[c]
        normal, shear = projected(normal, shear, tension[c], cohesion[c], friction[c])
        if normal != 0.0:
            for k in range(normal_pointers[c], normal_pointers[c + 1]):
                contact[normal_columns[k]] += normal_entries[k] * normal
        if shear != 0.0:
            for k in range(tangent_pointers[c], tangent_pointers[c + 1]):
                contact[tangent_columns[k]] += tangent_entries[k] * shear
    force = np.empty(n)
    inner_size, contact_size, load_size, rest_size = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        inner = 0.0
        for k in range(pointers[i], pointers[i + 1]):
            inner += entries[k] * increment[columns[k]]
        force[i] = inner + contact[i] - load[i]
        inner_size += (weight[i] * inner) ** 2
        contact_size += (weight[i] * contact[i]) ** 2
        load_size += (weight[i] * load[i]) ** 2
        rest_size += (weight[i] * force[i]) ** 2
    largest = max(inner_size, contact_size, load_size)
    return force, np.sqrt(rest_size / largest) if largest > 0.0 else 0.0


@compiled
def weighted(
    pointers: Index,
    rows: Index,
    entries: Floats,
    normal_pointers: Index,
    normal_columns: Index,
    normal_entries: Floats,
    normal_stiffness: Floats,
    tangent_pointers: Index,
    tangent_columns: Index,
    tangent_entries: Floats,
    shear_stiffness: Floats,
) -> Floats:
    """Inverse roots (n,) of the diagonal of matrix and springs; 1 where that is not positive."""
    found = np.zeros(len(pointers) - 1)
    for j in range(len(found)):
        for k in range(pointers[j], pointers[j + 1]):
            if rows[k] == j:
                found[j] += entries[k]
    for c in range(len(normal_stiffness)):
        for k in range(normal_pointers[c], normal_pointers[c + 1]):
            found[normal_columns[k]] += normal_entries[k] ** 2 * normal_stiffness[c]
    for c in range(len(shear_stiffness)):
        for k in range(tangent_pointers[c], tangent_pointers[c + 1]):
            found[tangent_columns[k]] += tangent_entries[k] ** 2 * shear_stiffness[c]
    for j in range(len(found)):
        found[j] = 1.0 / np.sqrt(found[j]) if found[j] > 0.0 else 1.0
    return found


@compiled
def meeting_forces(
    increment: Floats,
    load: Floats,
    normal: Floats,
    shear: Floats,
    pointers: Index,
    rows: Index,
    entries: Floats,
    normal_pointers: Index,
    normal_columns: Index,
    normal_entries: Floats,
    tangent_pointers: Index,
    tangent_columns: Index,
    tangent_entries: Floats,
) -> tuple[Floats, Floats]:
    """Out-of-balance force (n,) of given contact forces, and the sum of the sizes of its parts.

    A contact counts in the sizes with both its forces through either row.
    """
    rest, whole = -load, np.abs(load)
    for j in range(len(increment)):
        for k in range(pointers[j], pointers[j + 1]):
            part = entries[k] * increment[j]
            rest[rows[k]] += part
            whole[rows[k]] += abs(part)
    for c in range(len(normal)):
        pressed = abs(normal[c]) + abs(shear[c])
        for k in range(normal_pointers[c], normal_pointers[c + 1]):
            rest[normal_columns[k]] += normal_entries[k] * normal[c]
            whole[normal_columns[k]] += abs(normal_entries[k]) * pressed
        for k in range(tangent_pointers[c], tangent_pointers[c + 1]):
            rest[tangent_columns[k]] += tangent_entries[k] * shear[c]
            whole[tangent_columns[k]] += abs(tangent_entries[k]) * pressed
    return rest, whole
