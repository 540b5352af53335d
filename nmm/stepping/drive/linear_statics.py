"""Linear statics from Python: a model, effects, one solution in small displacements.

What scenes declare by numbers may here be functions of position: exact displacements and
tractions of a verification problem.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State, initial_state, strain_only
from nmm.assembly.places import Place
from nmm.constraints.bonded_interfaces import BondedInterfaces, glue_edges
from nmm.constraints.imposition import Method
from nmm.constraints.shared_edges import shared_edges
from nmm.constraints.supports import Supports
from nmm.effects.base import Effect, Instant, defines
from nmm.effects.field_loads import FieldLoad
from nmm.effects.loads import Load, Loads
from nmm.errors import FormulationError
from nmm.formulation import Glue, Solver
from nmm.model.plan import Plan
from nmm.model.solver_settings import solver_for
from nmm.solvers.bordered import bordered
from nmm.solvers.linear import Factor
from nmm.solvers.rigid_apart import ROUNDED, rounding, solve_apart
from nmm.stepping.step.rigid_bodies import rigid_bodies

Field = Callable[[Floats], Floats]

END = Instant(1.0, 1.0)


@dataclass(frozen=True)
class Equilibrium:
    """A solution.

    Attributes
    ----------
    model
        What was solved.
    state
        Displacements as ``state.deformation``.
    residual
        Relative out-of-balance force.
    factor
        The factorised system.
    effects
        What acts on it.
    """

    model: Model
    state: State
    residual: float
    factor: Factor
    effects: tuple[Effect, ...] = ()

    @property
    def energy(self) -> float:
        """Strain energy (J)."""
        u = self.state.deformation
        lifted = _plan(self.effects).lifted_energy(self.model, self._end)
        return 0.5 * float(u @ (self.model.stiffness @ u)) + lifted

    @property
    def pressure(self) -> Floats | None:
        """Pressures (k,) on patches (Pa); None where volumes are not projected."""
        return _plan(self.effects).pressure(self.model, self._end)

    @property
    def _end(self) -> State:
        return replace(self.state, time=END.time, load_factor=END.load_factor)


def equilibrium(
    model: Model, effects: Sequence[Effect], solver: Solver | None = None
) -> Equilibrium:
    """Solve the displacements of a model under effects.

    Raises
    ------
    SolveError
        No equilibrium: a part is free and the load moves it.
    FormulationError
        A material that is not linear.
    """
    if model.matter is not None:
        raise FormulationError(
            "linear statics: a material that is not linear: expected elastic laws: run a scene"
        )
    start = initial_state(model.manifold)
    n = model.manifold.n_unknowns
    held, force = csc_array((n, n)), np.zeros(n)
    linear = solver_for(model.manifold, solver or Solver())
    for effect in effects:
        if defines(effect, "matrix"):
            held = csc_array(held + effect.matrix(start))
        if defines(effect, "force"):
            force = force + effect.force(start, END)
    matrix = csc_array(model.stiffness + held)
    border = _plan(effects).border(start, END)
    if border is not None:
        matrix, force = bordered(matrix, border[0]), np.concatenate([force, border[1]])
        linear = linear.indefinite()
    factor = linear.factorise(matrix)
    found = factor.solve(force)
    residual = factor.relative_residual(found, force)
    bodies = rigid_bodies(model)
    if model.manifold.n_bodies > 1 and rounding(factor, bodies, found, force) > ROUNDED:
        apart = solve_apart(factor, bodies, held, force, None if border is None else border[0])
        if apart.residual < residual:
            state = strain_only(model, start, apart.strain, apart.rigid)
            return Equilibrium(model, state, apart.residual, factor, tuple(effects))
    state = strain_only(model, start, found[:n])
    return Equilibrium(model, state, residual, factor, tuple(effects))


def _plan(effects: Sequence[Effect]) -> Plan:
    return Plan({str(number): effect for number, effect in enumerate(effects)})


def hold(
    model: Model,
    place: Place,
    method: Method,
    displacement: Field | None = None,
    held: tuple[bool, bool] = (True, True),
) -> Supports:
    """Hold Gauss points of edges at a displacement that is a function of position (m, 2)."""
    values = np.zeros(2) if displacement is None else displacement(place.position)
    support = method.hold(model, place, lambda end: values, held)
    return Supports([support], model.manifold.n_unknowns, initial_state(model.manifold))


def glued(model: Model, method: str, size: float | None) -> BondedInterfaces:
    """Glue all blocks along the edges they share: "spring", "nitsche" or "lagrange".

    ``size`` is that of a mesh's cells (m), None for blocks.
    """
    ties = glue_edges(model, shared_edges(model), Glue.model_validate({"method": method}), size)
    return BondedInterfaces(ties, model.manifold.n_unknowns)


def traction(model: Model, place: Place, field: Callable[[Floats, Floats], Floats]) -> Loads:
    """Load Gauss points of edges by tractions ``field(points, normals)`` (m, 2) in Pa."""
    assert place.normal is not None
    values = field(place.position, place.normal) * model.thickness
    load = Load("edge", place, place.weight[:, None] * values, lambda end: 1.0)
    return Loads([load], model.manifold.n_unknowns)


def body_force(model: Model, field: Field, order: int) -> FieldLoad:
    """Load the volume by a force density ``field(points)`` (m, 2) in N/m3."""
    return FieldLoad.of(model, field, order)
