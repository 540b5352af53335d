"""Steady unconfined seepage: a free surface on a fixed mesh.

Below the free surface ``p > 0`` and water flows by Darcy's law; above it ``p = 0`` and nothing
flows. With the saturation ``s``, which is one where ``p > 0``, the whole domain satisfies (Brezis,
Kinderlehrer and Stampacchia 1978; Alt 1979)

    div (k (grad p / w + s grad y)) = 0,    p >= 0.

The pressure is the limit of those with ``s = min(p / (w l), 1)``, which are not negative by the
maximum principle, so that no inequality has to be imposed. The width ``l`` is about a cell, so that
gravity does not dominate diffusion in a cell and no upwinding is needed. Edges that are open to the
air have ``p = 0`` and let water out but not in, so that seepage faces find their ends. The flow
through a dam with vertical faces on a level base depends only on ``p`` at its faces, for any ``l``,
as the test function ``x`` shows: ``k (h1^2 - h2^2) / (2 L)`` (Charny 1951).

In terms of the head ``h = y + p / w`` the equation is that of saturated ground with a load,

    K h = f + int (1 - s) grad phi . k e_y.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats, Ints
from integration.rules import polygon_rule
from nmm.diffusion.problem import DiffusionProblem
from nmm.errors import SolveError

# Degree of the quadrature of the saturation, beyond that of the functions.
FINER = 6
# Residual over all flows at which Newton's method has converged, its largest number of iterations
# for each width, and the shortest step of its line search.
BALANCED, MOST, SHORTEST = 1e-11, 40, 2.0**-10
# Widths of a continuation, over the width of the answer.
WIDTHS = (8.0, 4.0, 2.0, 1.0)


@dataclass(frozen=True)
class Filling:
    """The saturation at quadrature points of all elements.

    Attributes
    ----------
    rows
        (Q, n) values of the functions at the points.
    height
        (Q,) y of the points (m).
    fall
        (n, Q) ``grad phi . k`` upright times the quadrature weight.
    width
        (E,) pressure head at which an element is saturated (m).
    owner, share
        (Q,) element of each point, and its share of the element.
    """

    rows: csr_array
    height: Floats
    fall: csr_array
    width: Floats
    owner: Ints
    share: Floats

    @classmethod
    def of(cls, space: ScalarSpace, conductance: Floats) -> "Filling":
        """Return it for a space; ``conductance`` (E, 2, 2) is conductivity times thickness."""
        manifold = space.manifold
        elements, degree = manifold.elements, manifold.degree + 1
        rule = polygon_rule(elements, 2 * degree + FINER)
        slopes = space.gradients(rule.owner, rule.points, conductance[rule.owner, :, 1])
        # Slivers take the width of the cells that they are cut from.
        size = np.sqrt(np.maximum(elements.areas, np.median(elements.areas))) / degree
        return cls(
            space.values(rule.owner, rule.points),
            rule.points[:, 1],
            csr_array(slopes.T @ diags_array(rule.weights)),
            size,
            rule.owner,
            rule.weights / elements.areas[rule.owner],
        )

    def filled(self, depth: Floats, elements: Ints, wider: float = 1.0) -> Floats:
        """Saturation (m,) at pressure heads (m,) (m) in elements (m,)."""
        return np.clip(depth / (wider * self.width[elements]), 0.0, 1.0)

    def load(self, head: Floats, wider: float = 1.0) -> Floats:
        """Return the load (n,) of the unsaturated part (m3/s)."""
        return np.asarray(self.fall @ (1 - self.filled(self.depth(head), self.owner, wider)))

    def slope(self, head: Floats, wider: float) -> csc_array:
        """Minus the derivative (n, n) of the load by the head."""
        return csc_array(self.fall @ (diags_array(self.steepness(head, wider)) @ self.rows))

    def steepness(self, head: Floats, wider: float) -> Floats:
        """Derivative (Q,) of the saturation by the head (1/m)."""
        depth, width = self.depth(head), wider * self.width[self.owner]
        return np.where((depth > 0) & (depth < width), 1 / width, 0.0)

    def at_rest(self, level: float, points: Floats) -> Floats:
        """Hydrostatic head (m,) at points (m, 2) of water at rest with a level (m).

        With ``dp / dy = -w s``, the pressure head decays above the level as ``l exp(-y / l)``, with
        as much water as is missing below.
        """
        width = float(np.median(self.width))
        below = level - points[:, 1]
        hangs = width * np.exp(np.minimum(below / width, 1.0) - 1)
        return points[:, 1] + np.where(below > width, below, hangs)

    def means(self, head: Floats) -> Floats:
        """Mean saturation (E,) of the elements."""
        filled = self.filled(self.depth(head), self.owner)
        return np.asarray(np.bincount(self.owner, self.share * filled, len(self.width)), float)

    def depth(self, head: Floats) -> Floats:
        """Pressure head (Q,) at the points (m)."""
        return np.asarray(self.rows @ head - self.height)


@dataclass(frozen=True, kw_only=True)
class FreeSurface(DiffusionProblem):
    """The problem of the hydraulic head with a free surface.

    Attributes
    ----------
    filling
        The saturation.
    """

    filling: Filling

    @classmethod
    def of(cls, problem: DiffusionProblem, filling: Filling) -> "FreeSurface":
        """Return a problem of saturated ground with a free surface."""
        parts = {one.name: getattr(problem, one.name) for one in fields(DiffusionProblem)}
        return cls(**parts, filling=filling)

    def rests(self, unknowns: Floats) -> bool:
        """See `DiffusionProblem.rests`: never, as the flow depends on the saturation."""
        return False

    def steady(self, time: float) -> Floats:
        """Return the unknowns (n,) of the steady head.

        Raises
        ------
        SolveError
            Newton's method does not converge.
        """
        found = super().steady(time)
        for wider in WIDTHS:
            found = self._newton(found, time, wider)
        return found

    def _newton(self, head: Floats, time: float, wider: float) -> Floats:
        """Return the head (n,) with widths times ``wider``, from a nearby one."""
        load = self.load(time)

        def residual_of(one: Floats) -> Floats:
            return np.asarray(load + self.filling.load(one, wider) - self.matrix @ one)

        def tangent(one: Floats) -> csc_array:
            return csc_array(self.matrix + self.filling.slope(one, wider))

        size = float(np.linalg.norm(load + self.filling.load(head, wider)))
        return self._balanced(head, FlowResidual(residual_of, tangent, size))

    def _balanced(self, head: Floats, residual: "FlowResidual") -> Floats:
        """Return the head (n,) of zero residual at free unknowns, from a nearby one."""
        free, solver, size = self.free, self.solver.unsymmetric(), residual.size
        left = residual.of(head)[free]
        for _ in range(MOST):
            if np.linalg.norm(left) <= BALANCED * size:
                return head
            tangent = residual.tangent(head)[free][:, free]
            way = np.zeros_like(head)
            way[free] = solver.factorise(csc_array(tangent)).refined(left)
            share = 1.0
            while True:
                trial, least = head + share * way, (1 - share / 4) * np.linalg.norm(left)
                after = residual.of(trial)[free]
                if np.linalg.norm(after) <= least or share <= SHORTEST:
                    break
                share /= 2
            head, left = trial, after
        raise SolveError(
            f"the free surface of seepage is {np.linalg.norm(left) / size:.1e} of all flows out of "
            f"balance after {MOST} solutions: take smaller cells, or shorter steps where it moves"
        )


@dataclass(frozen=True)
class FlowResidual:
    """The residual (n,) of a head (n,), minus its derivative (n, n), and a scale of it."""

    of: Callable[[Floats], Floats]
    tangent: Callable[[Floats], csc_array]
    size: float
