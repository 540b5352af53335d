"""Steady seepage with a free surface, on a net that stays.

Water fills the pores where its pressure is above that of the air, and flows there by Darcy's law;
elsewhere ``p = 0`` and nothing flows. With the share ``s`` of filled pores, one where ``p > 0``,
all of the ground obeys (Brezis, Kinderlehrer and Stampacchia 1978; Alt 1979)

    div (k (grad p / w + s grad y)) = 0,    p >= 0.

The pressure is the limit of those with ``s = min(p / (w l), 1)``, of which none is negative, by the
principle of the maximum: no condition has to be imposed. ``l`` is about a cell, so that what falls
through a cell weighs no more than what spreads through it and no upwinding is needed. Edges that
are open to the air have ``p = 0``, where water leaves and none comes in: seepage faces end by
themselves. What flows through a wall with upright faces on an even base hangs on ``p`` on its faces
alone, whatever ``l`` is, as the field ``x`` tests it: ``k (h1^2 - h2^2) / (2 L)`` (Charny 1951).

In the head ``h = y + p / w`` the equation is that of saturated ground with a load,

    K h = f + int k (1 - s) dphi / dy.
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

# Degree of the rule that integrates the share of filled pores, beyond that of the functions.
FINER = 6
# Out-of-balance flow, as a share of all flows, that is rounding; solutions for each width; and the
# least share of a step.
BALANCED, MOST, SHORTEST = 1e-11, 40, 2.0**-10
# Widths, in that of the answer, through which it is followed.
WIDTHS = (8.0, 4.0, 2.0, 1.0)


@dataclass(frozen=True)
class Filling:
    """How far pores are filled, at points of all elements.

    Attributes
    ----------
    rows
        (Q, n) head at the points.
    height
        (Q,) their y (m).
    fall
        (n, Q) ``k dphi / dy`` times the part of the volume that a point stands for.
    width
        (E,) pressure head at which pores of an element are full (m).
    owner, share
        (Q,) element of each point, and its part of the element.
    """

    rows: csr_array
    height: Floats
    fall: csr_array
    width: Floats
    owner: Ints
    share: Floats

    @classmethod
    def of(cls, space: ScalarSpace, conductance: Floats) -> "Filling":
        """Return that of a space; ``conductance`` (E,) is conductivity times thickness."""
        manifold = space.manifold
        elements, degree = manifold.elements, manifold.degree + 1
        rule = polygon_rule(elements, 2 * degree + FINER)
        upright = np.broadcast_to([0.0, 1.0], rule.points.shape)
        slopes = space.gradients(rule.owner, rule.points, upright)
        # Slivers have the width of the cells that they are cut from.
        size = np.sqrt(np.maximum(elements.areas, np.median(elements.areas))) / degree
        return cls(
            space.values(rule.owner, rule.points),
            rule.points[:, 1],
            csr_array(slopes.T @ diags_array(rule.weights * conductance[rule.owner])),
            size,
            rule.owner,
            rule.weights / elements.areas[rule.owner],
        )

    def filled(self, depth: Floats, elements: Ints, wider: float = 1.0) -> Floats:
        """Share (m,) of filled pores at pressure heads (m,) in elements (m,)."""
        return np.clip(depth / (wider * self.width[elements]), 0.0, 1.0)

    def load(self, head: Floats, wider: float = 1.0) -> Floats:
        """Return the load (n,) of what is not filled."""
        return np.asarray(self.fall @ (1 - self.filled(self.depth(head), self.owner, wider)))

    def slope(self, head: Floats, wider: float) -> csc_array:
        """Derivative (n, n) of the load by the head, with the sign changed."""
        return csc_array(self.fall @ (diags_array(self.steepness(head, wider)) @ self.rows))

    def steepness(self, head: Floats, wider: float) -> Floats:
        """Derivative (Q,) of the share of filled pores by the head (1/m)."""
        depth, width = self.depth(head), wider * self.width[self.owner]
        return np.where((depth > 0) & (depth < width), 1 / width, 0.0)

    def at_rest(self, level: float, points: Floats) -> Floats:
        """Head (m,) at points (m, 2) of water that stands at a level (m) and does not flow.

        ``p' = -w s`` upwards: pores that are filled in part hang on to ``l exp(-y / l)``, as much
        as what is missing below the level.
        """
        width = float(np.median(self.width))
        below = level - points[:, 1]
        hangs = width * np.exp(np.minimum(below / width, 1.0) - 1)
        return points[:, 1] + np.where(below > width, below, hangs)

    def means(self, head: Floats) -> Floats:
        """Mean share (E,) of filled pores of the elements."""
        filled = self.filled(self.depth(head), self.owner)
        return np.asarray(np.bincount(self.owner, self.share * filled, len(self.width)), float)

    def depth(self, head: Floats) -> Floats:
        """Pressure head (Q,) at the points (m)."""
        return np.asarray(self.rows @ head - self.height)


@dataclass(frozen=True, kw_only=True)
class FreeSurface(DiffusionProblem):
    """The head of ground that water fills in part.

    Attributes
    ----------
    filling
        How far its pores are filled.
    """

    filling: Filling

    @classmethod
    def of(cls, problem: DiffusionProblem, filling: Filling) -> "FreeSurface":
        """Return a problem of saturated ground with a free surface."""
        parts = {one.name: getattr(problem, one.name) for one in fields(DiffusionProblem)}
        return cls(**parts, filling=filling)

    def rests(self, unknowns: Floats) -> bool:
        """See `DiffusionProblem.rests`: what flows hangs on how far pores are filled."""
        return False

    def steady(self, time: float) -> Floats:
        """Unknowns (n,) of the head.

        Raises
        ------
        SolveError
            Where none is found.
        """
        found = super().steady(time)
        for wider in WIDTHS:
            found = self._newton(found, time, wider)
        return found

    def _newton(self, head: Floats, time: float, wider: float) -> Floats:
        """Return the head (n,) with widths so much wider, from one nearby."""
        load = self.load(time)

        def missing(one: Floats) -> Floats:
            return np.asarray(load + self.filling.load(one, wider) - self.matrix @ one)

        def tangent(one: Floats) -> csc_array:
            return csc_array(self.matrix + self.filling.slope(one, wider))

        size = float(np.linalg.norm(load + self.filling.load(head, wider)))
        return self._balanced(head, Unbalanced(missing, tangent, size))

    def _balanced(self, head: Floats, unbalanced: "Unbalanced") -> Floats:
        """Return the head (n,) from one nearby whose free part misses nothing."""
        free, solver, size = self.free, self.solver.unsymmetric(), unbalanced.size
        left = unbalanced.missing(head)[free]
        for _ in range(MOST):
            if np.linalg.norm(left) <= BALANCED * size:
                return head
            tangent = unbalanced.tangent(head)[free][:, free]
            way = np.zeros_like(head)
            way[free] = solver.factorise(csc_array(tangent)).refined(left)
            share = 1.0
            while True:
                trial, least = head + share * way, (1 - share / 4) * np.linalg.norm(left)
                after = unbalanced.missing(trial)[free]
                if np.linalg.norm(after) <= least or share <= SHORTEST:
                    break
                share /= 2
            head, left = trial, after
        raise SolveError(
            f"the free surface of seepage is {np.linalg.norm(left) / size:.1e} of all flows out of "
            f"balance after {MOST} solutions: take smaller cells, or shorter steps where it moves"
        )


@dataclass(frozen=True)
class Unbalanced:
    """What a head (n,) misses (n,), its derivative (n, n) with the sign changed, and its size."""

    missing: Callable[[Floats], Floats]
    tangent: Callable[[Floats], csc_array]
    size: float
