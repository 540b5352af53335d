"""Forces at both ends of all joints between polygons: a linear programme over those admissible."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Self

import numpy as np

from integration.arrays import Floats

# Joints that are shorter (m) are corners that touch.
SHORTEST = 1e-6
# The factor is found to this width.
FINE = 1e-5


@dataclass(frozen=True)
class JointForces:
    """Pressures and shear forces at the ends of joints, and what they are to balance.

    Attributes
    ----------
    balance
        (3 n, 2 m) of pressure and shear at each end, in turns, on forces and moments of the blocks.
    weight
        (3 n,) of the blocks (N).
    length
        (m,) half of the joint (m), which belongs to each end.
    """

    balance: Floats
    weight: Floats
    length: Floats

    @classmethod
    def of(cls, blocks: Sequence[Any], ground: Any, unit_weight: float) -> Self:
        """Return those of polygons, of N/m3, on and before ground that is held."""
        bodies, columns, length = [*blocks, ground], list[Floats](), list[float]()
        for a, one in enumerate(blocks):
            for b in range(a + 1, len(bodies)):
                for face in _shared(one, bodies[b]):
                    columns += _columns(face, a, b, blocks)
                    length += [float(np.hypot(*(face[1] - face[0]))) / 2] * 2
        weight = np.zeros(3 * len(blocks))
        weight[1::3] = [-unit_weight * one.area for one in blocks]
        return cls(np.array(columns).T, weight, np.array(length))

    def factor(self, friction: float, cohesion: float = 0.0, highest: float = 4.0) -> float:
        """Return the least factor on strengths (tangent, Pa) with which nothing carries."""
        low, high = 0.1, highest
        while high - low > FINE:
            middle = (low + high) / 2
            carries = self._carries(friction / middle, cohesion / middle)
            low, high = (middle, high) if carries else (low, middle)
        return high

    def _carries(self, friction: float, cohesion: float) -> bool:
        """Whether pressures and shear forces ``|t| <= c l + mu p`` carry the weight."""
        from scipy import optimize
        from scipy.sparse import csr_array, eye_array, kron

        m, unit = len(self.length), float(np.abs(self.weight).max())
        pair = np.array([[-friction, 1.0], [-friction, -1.0]])
        linprog: Any = optimize.linprog
        found = linprog(
            np.zeros(2 * m),
            A_ub=csr_array(kron(eye_array(m), pair)),
            b_ub=np.repeat(cohesion * self.length, 2) / unit,
            A_eq=csr_array(self.balance),
            b_eq=-self.weight / unit,
            bounds=[(0.0, None), (None, None)] * m,
            method="highs",
        )
        return bool(found.status == 0)


def _shared(one: Any, other: Any) -> list[Floats]:
    """Edges (2, 2) that two polygons share."""
    shared = one.intersection(other)
    if shared.length < SHORTEST:
        return []
    faces = [
        np.array(face)
        for part in getattr(shared, "geoms", [shared])
        for face in pairwise(np.array(part.coords))
    ]
    return [face for face in faces if np.hypot(*(face[1] - face[0])) > SHORTEST]


def _columns(ends: Floats, a: int, b: int, blocks: Sequence[Any]) -> list[Floats]:
    """Columns (3 n,) of pressure and shear at both ends of a joint, on the blocks beside it."""
    along = (ends[1] - ends[0]) / np.hypot(*(ends[1] - ends[0]))
    normal = np.array([-along[1], along[0]])
    if (np.array(blocks[a].centroid.coords[0]) - ends[0]) @ normal < 0:
        normal = -normal
    found = []
    for end in ends:
        for push in (normal, along):
            column = np.zeros(3 * len(blocks))
            for body, sign in ((a, 1.0), (b, -1.0)):
                if body < len(blocks):
                    arm = end - np.array(blocks[body].centroid.coords[0])
                    column[3 * body : 3 * body + 2] += sign * push
                    column[3 * body + 2] += sign * (arm[0] * push[1] - arm[1] * push[0])
            found.append(column)
    return found
