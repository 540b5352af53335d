"""Linear statics from Python: a model, effects, one solution in small displacements.

What scenes declare by numbers may here be functions of position: exact displacements and
tractions of a verification problem.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State, initial_state
from nmm.constraints.imposition import Method
from nmm.constraints.supports import Supports
from nmm.constraints.ties.bonded_interfaces import BondedInterfaces, glue_edges
from nmm.constraints.ties.shared_edges import shared_edges
from nmm.effects.base import Effect, Instant
from nmm.effects.loading.field_loads import FieldLoads, SpreadLoad
from nmm.effects.loading.fields import ValueField
from nmm.effects.loading.loads import Load, Loads
from nmm.errors import FormulationError
from nmm.formulation import Glue, IntegratorTable, Solver
from nmm.integrators.base import make_integrator
from nmm.model.planning.plan import Plan
from nmm.model.planning.pressures import lifted_energy, patch_pressures
from nmm.model.solver_settings import solver_for
from nmm.solvers.linear import Factor
from nmm.stepping.step.linear.assembly import Assembly
from nmm.stepping.step.linear.linear_system import LinearSystem

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
        lifted = lifted_energy(_plan(self.effects), self.model, self._end)
        return 0.5 * float(u @ (self.model.stiffness @ u)) + lifted

    @property
    def pressure(self) -> Floats | None:
        """Pressures (k,) on patches (Pa); None where volumes are not projected."""
        return patch_pressures(_plan(self.effects), self.model, self._end)

    @property
    def _end(self) -> State:
        return replace(self.state, time=END.time, load_factor=END.load_factor)


@dataclass(frozen=True)
class LinearStatics:
    """A model and effects on it that no scene names."""

    model: Model
    plan: Plan


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
            f"linear statics: {model.bent}: expected elastic laws of small strain: run a scene"
        )
    solved = LinearStatics(model, _plan(effects))
    system = LinearSystem(solved, solver_for(model.manifold, solver or Solver()), small=True)
    start = initial_state(model.manifold)
    equations = Assembly(solved).of(
        start, END, None, make_integrator(IntegratorTable()), anchored=False
    )
    solution = system.solve(equations)
    assert system.factor is not None
    state = solution.moved(model, start)
    return Equilibrium(model, state, solution.residual, system.factor, tuple(effects))


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
    return Loads([load], model)


def body_force(model: Model, field: Field, order: int) -> FieldLoads:
    """Load the volume by a force density ``field(points)`` (m, 2) in N/m3."""
    density = ValueField(False, lambda points, time: field(points), np.zeros(2), "body force")
    load = SpreadLoad.over_volume(model, density, order)
    return FieldLoads([load], model)
