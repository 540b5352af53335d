"""Mortar contact: one exact constraint, averaged over faces, for each multiplier node.

The points of overlaps integrate a pressure exactly (`nmm.contact.mortar.segments`), but are more
than exact conditions may hold one by one. So the pressure is made of functions ``phi_j >= 0`` of
places (`nmm.contact.mortar.multiplier_basis`), whose sum is one:

    p = sum_j p_j phi_j,    p_j >= 0,    int phi_j gap >= 0,    p_j int phi_j gap = 0,

with friction of the same form (McDevitt and Laursen 2000; Hüeber and Wohlmuth 2005; Popp et al.
2009). A uniform pressure is among them: the contact patch test holds as with points.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from scipy.sparse import block_diag, csc_array, csr_array, eye_array

from integration.arrays import Floats, Ints
from integration.ragged import offsets, ranges
from nmm.contact.detection.surface import Surface
from nmm.contact.mortar.multiplier_basis import Entries, functions_along
from nmm.contact.mortar.trace_space import TraceSpace
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import OPEN, Limits, StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform


@dataclass(frozen=True, eq=False)
class FaceMeans(Transform):
    """Functions of multiplier nodes at the contacts of a problem.

    Attributes
    ----------
    functions
        (k, m) values ``phi_j`` at the points; contacts that are alone have a row with a 1.
    share
        (k, m) weights of the points in the mean over a function; each row sums to one.
    nearest
        (k,) the point where each function is largest.
    """

    functions: csr_array
    share: csr_array
    nearest: Ints

    @classmethod
    def of(cls, contacts: ContactPoints, surface: Surface, space: TraceSpace) -> Self | None:
        """Return the functions of the runs of faces among contacts; None without any."""
        found = functions_along(contacts, surface, space)
        if not len(found.point):
            return None
        m = len(contacts)
        alone = np.ones(m, dtype=bool)
        alone[found.point] = False
        function, k = _in_order(found, np.flatnonzero(alone), m)
        point = np.concatenate([found.point, np.flatnonzero(alone)])
        value = np.concatenate([found.value, np.ones(int(alone.sum()))])
        weight = value * np.where(alone, 1.0, contacts.length)[point]
        share = weight / np.bincount(function, weight, k)[function]
        functions = csr_array((value, (function, point)), shape=(k, m))
        return cls(
            functions, csr_array((share, (function, point)), shape=(k, m)), _largest(functions)
        )

    def _wider(self, m: int) -> Self:
        """Return the functions extended by further contacts, which are not averaged."""
        more = m - self.functions.shape[1]
        if not more:
            return self
        functions, share = (
            csr_array(block_diag([part, eye_array(more)], format="csr"))
            for part in (self.functions, self.share)
        )
        return replace(
            self,
            functions=functions,
            share=share,
            nearest=np.concatenate([self.nearest, np.arange(m - more, m)]),
        )

    def apply(self, problem: StepProblem) -> StepProblem:
        """Return the problem of the means."""
        wide, limits = self._wider(problem.n_contacts), problem.limits
        functions, share, nearest = wide.functions, wide.share, wide.nearest
        # Forces to start from: the pressure at the nearest point over all of the function.
        part = share[np.arange(len(nearest)), nearest]
        return replace(
            problem,
            normal_rows=_means(share, problem.normal_rows),
            tangent_rows=_means(share, problem.tangent_rows),
            gap=share @ problem.gap,
            slip=share @ problem.slip,
            normal_stiffness=functions @ problem.normal_stiffness,
            shear_stiffness=functions @ problem.shear_stiffness,
            limits=Limits(
                tension=functions @ limits.tension,
                cohesion=functions @ limits.cohesion,
                friction=share @ limits.friction,
            ),
            state=problem.state[nearest],
            normal_force=problem.normal_force[nearest] / part,
            shear_force=problem.shear_force[nearest] / part,
            compliant=problem.own_stiffness[nearest],
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        """Return the answer at the points; forces are those of the pressure there.

        Gaps are those of the points: only their means are zero. What slid under load is made of
        the functions, so that its work and the means of the slip that is left are right.
        """
        wide, increment = self._wider(problem.n_contacts), answer.increment
        share = wide.share
        normal, shear = share.T @ answer.normal_force, share.T @ answer.shear_force
        slid = wide._made_of_functions(share @ problem.slips(increment) - answer.slip)
        # The function with the largest part in a point's force says what the point does.
        size = np.abs(answer.normal_force) + np.abs(answer.shear_force)
        felt = csr_array(share.T)
        felt.data = felt.data * (size + 1e-300)[felt.indices]
        leading = _largest(felt)
        alone = (np.diff(share.indptr)[leading] == 1) & (np.diff(felt.indptr) == 1)
        rests = ~alone & (normal == 0) & (shear == 0)
        return replace(
            answer,
            normal_force=normal,
            shear_force=shear,
            gap=np.where(alone, answer.gap[leading], problem.gaps(increment)),
            slip=np.where(alone, answer.slip[leading], problem.slips(increment) - slid),
            state=np.where(rests, OPEN, answer.state[leading]),
        )

    def _made_of_functions(self, means: Floats) -> Floats:
        """Values (m,) at the points of a sum of the functions with given means (k,)."""
        from scipy.sparse.linalg import spsolve

        if not means.any():
            return np.zeros(self.functions.shape[1])
        turned = csc_array(self.functions.T)
        return np.asarray(turned @ spsolve(csc_array(self.share @ turned), means))


def _in_order(found: Entries, single: Ints, m: int) -> tuple[Ints, int]:
    """Functions of all entries, those of single points behind, numbered as their points are."""
    many = int(found.function.max()) + 1
    function = np.concatenate([found.function, many + np.arange(len(single))])
    first = np.full(many + len(single), m)
    np.minimum.at(first, function, np.concatenate([found.point, single]))
    rank = np.empty(len(first), dtype=np.int64)
    rank[np.argsort(first, kind="stable")] = np.arange(len(first))
    return rank[function], len(first)


def _largest(matrix: csr_array) -> Ints:
    """Column (k,) of the largest entry of each row; none of the rows is empty."""
    row = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    order = np.lexsort((-matrix.data, row))
    return np.asarray(matrix.indices[order[matrix.indptr[:-1]]], dtype=np.int64)


def _means(share: csr_array, rows: csr_array) -> csr_array:
    """``share @ rows`` with zeros kept, so that normal and tangent rows have one pattern."""
    entry, count = ranges(rows.indptr.astype(np.int64), share.indices.astype(np.int64))
    found = csr_array(
        (
            rows.data[entry] * np.repeat(share.data, count),
            rows.indices[entry],
            offsets(count)[share.indptr].astype(rows.indptr.dtype),
        ),
        shape=(share.shape[0], rows.shape[1]),
    )
    found.sum_duplicates()
    return found
