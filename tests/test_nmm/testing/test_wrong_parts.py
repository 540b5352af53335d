"""Every suite can fail: parts with one fault each are told, by the property that they break."""

import re
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.sparse import csc_array

from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons
from nmm.constraints.springs import Springs
from nmm.contact.enforcement.barrier import Barrier
from nmm.contact.enforcement.cone import Cone
from nmm.contact.enforcement.penalty import Penalty
from nmm.errors import SolveError
from nmm.geometry.tessellation.block_cover import BlockCover
from nmm.integrators.newmark import Newmark
from nmm.outputs.base import Output
from nmm.outputs.stresses import VonMises
from nmm.quantity import Quantity
from nmm.solvers.libraries.superlu import SuperLU
from nmm.testing import (
    check_block_cover,
    check_cover,
    check_enforcement,
    check_imposition,
    check_integrator,
    check_output,
    check_smooth_enforcement,
    check_solver,
)

BOUNDS = [[0.0, 0.0], [2.0, 1.0]]


def told(words):
    return pytest.raises(AssertionError, match=re.escape(words))


class HeavyWeight(Triangles):
    def evaluate(self, cells, points):
        weights, gradients = super().evaluate(cells, points)
        return weights * [1.0, 1.0, 1.0 + 1e-9], gradients


class FlatSlopes(Triangles):
    def evaluate(self, cells, points):
        weights, gradients = super().evaluate(cells, points)
        return weights, 0.99 * gradients


class Boastful(MovingLeastSquares):
    @property
    def precision(self):
        return 2


class Modest(MovingLeastSquares):
    @property
    def precision(self):
        return 0


class OtherTables(Quads):
    def weight_tables(self, cells, origin, scale):
        table, degree = super().weight_tables(cells, origin, 1.001 * scale)
        return table, degree


COVERS = {
    "the sum of the weights": lambda: HeavyWeight.regular(BOUNDS, 0.3),
    "against differences of weights": lambda: FlatSlopes.regular(BOUNDS, 0.3),
    "polynomials of degree 2 are missed": lambda: Boastful.regular(BOUNDS, 0.3, degree=1),
    "precision 0 claimed, 1 found": lambda: Modest.regular(BOUNDS, 0.3, degree=1),
    "weights by tables": lambda: OtherTables.regular(BOUNDS, 0.3),
    "times its patch_size": lambda: replace(
        found := Quads.regular(BOUNDS, 0.3), patch_size=0.7 * found.patch_size
    ),
    "weighted patch centres": lambda: replace(
        found := Quads.regular(BOUNDS, 0.3), patch_centre=found.patch_centre + 1e-6
    ),
}


@pytest.mark.parametrize("words", COVERS)
def test_a_wrong_cover_is_told(words):
    with told(words):
        check_cover(COVERS[words]())


class Attractive(Penalty):
    """Contacts that hold what they should let go."""

    def solve(self, problem, linear_solver, memory=None):
        sticky = replace(problem.limits, tension=problem.limits.tension + 0.05)
        return super().solve(replace(problem, limits=sticky), linear_solver, memory)


class Rough(Penalty):
    """More friction than there is."""

    def solve(self, problem, linear_solver, memory=None):
        rough = replace(problem.limits, friction=1.1 * problem.limits.friction)
        return super().solve(replace(problem, limits=rough), linear_solver, memory)


class Unbalanced(Cone):
    """Forces of one part in a million too small."""

    def solve(self, problem, linear_solver, memory=None):
        answer = super().solve(problem, linear_solver, memory)
        return replace(answer, normal_force=(1 - 1e-5) * answer.normal_force)


class Hopeful(Cone):
    """Claims what it has not found."""

    def solve(self, problem, linear_solver, memory=None):
        answer = super().solve(problem, linear_solver, memory)
        verdict = replace(answer.verdict, converged=True, code="converged")
        return replace(answer, verdict=verdict)


class Stubborn(Cone):
    """Gives up where there is a solution."""

    def solve(self, problem, linear_solver, memory=None):
        answer = super().solve(problem, linear_solver, memory)
        verdict = replace(answer.verdict, converged=False, code="passes", sentence="no more")
        return replace(answer, verdict=verdict)


ENFORCEMENTS = {
    "an unbonded contact pulls": Attractive,
    "off every solution": Rough,
    "out of balance": Unbalanced,
    'expected the code "singular"': Hopeful,
    "not solved: no more": Stubborn,
}


@pytest.mark.parametrize("words", ENFORCEMENTS)
def test_a_wrong_enforcement_is_told(words):
    with told(words):
        check_enforcement(ENFORCEMENTS[words]())


def test_springs_that_are_called_exact_are_told():
    with told("off every solution"):
        check_enforcement(Penalty(), exact=True)


def test_a_width_that_does_not_vanish_is_told():
    with told("a hundredth of the width leaves"):
        check_smooth_enforcement(lambda width: Barrier(width=1e-2))


@dataclass(frozen=True)
class Heavy(Newmark):
    """A mass of a tenth more than its momentum."""

    def mass_factor(self, step):
        return 1.1 * super().mass_factor(step)


@dataclass(frozen=True)
class Kicked(Newmark):
    """A contact that gives more than its impulse."""

    @property
    def contact_kick(self):
        return 0.01, 0.0


@dataclass(frozen=True)
class Explicit(Newmark):
    """Forces of the start alone: stable for small steps only."""

    @property
    def end_weight(self):
        return 0.3


INTEGRATORS = {
    "place of a free body": Heavy(),
    "momentum gained from a contact's impulse": Kicked(),
    "a vibration with omega dt": Explicit(),
}


@pytest.mark.parametrize("words", INTEGRATORS)
def test_a_wrong_integrator_is_told(words):
    with told(words):
        check_integrator(INTEGRATORS[words])


@dataclass(frozen=True)
class Stale(Newmark):
    """Velocities by the acceleration at the start of the run: exact while forces stay."""

    def rates(self, increment, velocity, acceleration, step):
        return velocity + step * acceleration, acceleration

    @property
    def contact_kick(self):
        return 1.0, 0.0


def test_an_integrator_of_order_nothing_is_told():
    with told(": order "):
        check_integrator(Stale())


def test_an_order_that_is_claimed_and_not_reached_is_told():
    with told("expected at least 2"):
        check_integrator(Newmark(beta=0.3025, gamma=0.6), order=2.0)


@dataclass(frozen=True)
class Inexact(SuperLU):
    """Matrices of which a part in a million is lost."""

    def factorise(self, matrix):
        return super().factorise(csc_array(matrix * (1 + 1e-6)))


@dataclass(frozen=True)
class Silent(SuperLU):
    """Answers, whatever the load on a free motion."""

    def factorise(self, matrix):
        factor = super().factorise(matrix)

        class Any:
            relative_residual = factor.relative_residual
            condition = factor.condition

            def solve(self, rhs):
                try:
                    return factor.solve(rhs)
                except SolveError:
                    return np.zeros(len(rhs))

        return Any()


SOLVERS = {"against dense algebra": Inexact(), "a load on a free motion is solved": Silent()}


@pytest.mark.parametrize("words", SOLVERS)
def test_a_wrong_solver_is_told(words):
    with told(words):
        check_solver(SOLVERS[words])


class Narrow(Output):
    def fields(self, view):
        return {"area": Quantity("points", np.ones(3))}


class Namesake(VonMises):
    def fields(self, view):
        return {"stress": super().fields(view)["von_mises"]}


class Restless(Output):
    count = 0

    def fields(self, view):
        self.count += 1
        return {"count": Quantity("bodies", np.full(2, float(self.count)))}


class Spoiling(VonMises):
    def fields(self, view):
        view.stress[0] += 1.0
        return super().fields(view)


OUTPUTS = {
    "3 rows, expected 8 on points": Narrow,
    "the name is that of a frame's own": Namesake,
    "differs when it is asked for again": Restless,
    "neither fields nor history": Output,
    "quantity von_mises differs": Spoiling,
}


@pytest.mark.parametrize("words", OUTPUTS)
def test_a_wrong_output_is_told(words):
    with told(words):
        check_output(OUTPUTS[words]())


class Doubled(Springs):
    def energy(self, state, jump):
        return 2 * super().energy(state, jump)


class Slack(Springs):
    def matrix(self, state):
        row, column, value = super().matrix(state)
        return row, column, 0.99 * value


class Unpaired(Springs):
    def force(self, state, jump):
        return self.interface.first.points.push(state, self.point_forces(state, jump))


class Quiet(Springs):
    """Half of what it does is in the forces of its points."""

    def force(self, state, jump):
        return 2 * super().force(state, jump)

    def point_forces(self, state, jump):
        return 0.5 * super().point_forces(state, jump)


IMPOSITIONS = {
    "Doubled, glue: force on a way": Doubled,
    "Slack, glue: matrix times a way": Slack,
    "Unpaired, glue: force on a way": Unpaired,
    "Quiet, ground: force on all bodies": Quiet,
}


@pytest.mark.parametrize("words", IMPOSITIONS)
def test_a_wrong_imposition_is_told(words):
    with told(words):
        check_imposition(IMPOSITIONS[words])


@dataclass(frozen=True)
class Lower(BlockCover):
    """Boxes cut at a height of their own, of which the pieces are given."""

    divides = True
    ends: tuple[float, ...] = (0.0, 0.5, 1.0)
    sources: tuple[int, ...] = (0, 0, 1, 1)

    def divided(self, blocks, size, angle, shift):
        pieces = [
            np.array([[x, a], [x + w, a], [x + w, b], [x, b]])
            for x, w in ((0.0, 1.0), (1.0, 2.0))
            for a, b in zip(self.ends[::2], self.ends[1::2], strict=True)
        ]
        return Polygons.from_vertices(pieces), np.array(self.sources)


BLOCK_COVERS = {
    "block 0: areas of its pieces: off by 0.25": Lower((0.0, 0.5, 0.5, 0.75)),
    "block 0: areas of its pieces as one": Lower((0.0, 0.6, 0.5, 0.9)),
    "block 0: areas of its pieces outside": Lower((0.0, 0.5, 0.6, 1.1)),
    "sources are not the 2 blocks": Lower((0.0, 0.5, 0.5, 1.0), (0, 0, 0, 2)),
    "3 sources of 4 pieces": Lower((0.0, 0.5, 0.5, 1.0), (0, 0, 1)),
}


@pytest.mark.parametrize("words", BLOCK_COVERS)
def test_a_wrong_block_cover_is_told(words):
    with told(words):
        check_block_cover(BLOCK_COVERS[words])


def test_a_block_cover_that_is_right_is_not_told():
    check_block_cover(Lower((0.0, 0.5, 0.5, 1.0)))
