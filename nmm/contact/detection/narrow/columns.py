"""Columns of the contacts that the compiled narrow phase found."""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled
from nmm.contact.detection.narrow.kinks import beside_kink
from nmm.contact.detection.narrow.tables import Shape, Small
from nmm.contact.detection.tolerances import Rules

Columns = tuple[Ints, Ints, Floats, Floats, Floats, Ints, Ints, Ints, Ints]
"""Those of `contacts.Contacts`."""


@compiled
def describe(
    shape: Shape,
    vertex: Ints,
    edge: Ints,
    rows: Ints,
    final: Small,
    s: Floats,
    gap: Floats,
    rules: Rules,
) -> Columns:
    """Columns of `contacts.Contacts` for the kept rows."""
    m, n = len(rows), len(shape)
    v, e, key = np.empty(m, np.int64), np.empty(m, np.int64), np.empty(m, np.int64)
    body, corner = np.empty(m, np.int64), np.empty(m, np.int64)
    kind = np.empty(m, np.int64)
    parameter, normal, distance = np.empty(m), np.empty((m, 2)), np.empty(m)
    for i in range(m):
        k = rows[i]
        v[i], e[i], distance[i] = vertex[k], edge[k], gap[k]
        x = e[i]
        key[i], body[i] = v[i] * n + x, shape[x].body
        parameter[i] = min(max(s[k] / shape[x].length, 0.0), 1.0)
        normal[i, 0], normal[i, 1] = shape[x].ty, -shape[x].tx
        corner[i] = shape[x].next if parameter[i] > 0.5 else x
        beside = min(abs(s[k]), abs(shape[x].length - s[k]))
        thin = min(shape[v[i]].thick, shape[x].thick)
        near = beside <= rules.flush * thin + rules.rounding or final[k] == 2
        # In a kink of two it stands for this edge alone.
        apart = near and beside_kink(shape, v[i], x, int(parameter[i] > 0.5), rules) >= 0
        kind[i] = 1 if near and not apart else 0
    return v, e, parameter, normal, distance, kind, key, body, corner
