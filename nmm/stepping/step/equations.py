"""The equations of one step but for contact: material, inertia, supports and loads.

Matter that is not linear enters by its `Linearisation` at an iterate of the step: the equations
stay linear in the whole increment, whatever the iterate.
"""

from dataclasses import dataclass

from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.integrators.base import Integrator
from nmm.integrators.damping import Damping
from nmm.solvers.unchecked import product


@dataclass(frozen=True)
class Linearisation:
    """Internal forces near an iterate of a step, ``force + stiffness @ d`` of its increment.

    Attributes
    ----------
    stiffness
        (n, n) tangent.
    force
        (n,) that the line has at the start of the step: that of the stress there, where it is one.
    start
        (n,) of the stress at the start of the step.
    symmetric
        Whether the tangent is.
    """

    stiffness: csc_array
    force: Floats
    start: Floats
    symmetric: bool = True

    @classmethod
    def linear(cls, model: Model, state: State) -> "Linearisation":
        """Return that of linear matter, the same at all iterates."""
        force = product(model.stiffness, state.deformation)
        return cls(model.stiffness, force, force)


@dataclass(frozen=True)
class InertiaTerms:
    """What inertia adds to the equations of a step.

    Attributes
    ----------
    mass, factor
        The matrix (n, n) and its factor in the step's matrix.
    momentum
        (n,) that joins the forces.
    rates
        (n,) whose product with the mass the momentum is.
    outwards
        (n,) the centrifugal force among the forces, whose work the spin pays for.
    turned_less
        (n,) by how much less strained bodies turn than by their spin; None where none does.
    weight, contact_factor
        See `nmm.integrators.base`.
    gain
        (n,) by how much all forces but the matrix grow in the step, what its tangent misses of
        the material among them; None where nothing does.
    applied
        (n,) of it what is no way of supports and no material: loads, and stresses of effects.
    damping
        Dampers; None without any.
    elastic
        All that is elastic (n, n), where it is no part of the step's matrix.
    """

    mass: csc_array
    factor: float
    momentum: Floats
    rates: Floats
    outwards: Floats
    turned_less: Floats | None
    weight: float
    contact_factor: float
    gain: Floats | None
    applied: Floats | None = None
    damping: Damping | None = None
    elastic: csc_array | None = None


@dataclass(frozen=True)
class Equations:
    """``matrix @ d = force`` for the unknowns ``d`` of a step.

    Attributes
    ----------
    state, end
        Where the step starts, and when it ends.
    step
        Its length (s); None in statics.
    rule
        How rates follow from the increment.
    matrix, force
        (n, n) and (n,).
    inertia
        Its terms; None in statics.
    symmetric
        Whether the matrix is.
    among
        (n,) size of the forces that ``force`` is the sum of, where rounding of them counts: of
        dependent functions. In time that of elastic and applied forces at the end of the step.
    """

    state: State
    end: Instant
    step: float | None
    rule: Integrator
    matrix: csc_array
    force: Floats
    inertia: InertiaTerms | None = None
    symmetric: bool = True
    among: Floats | None = None
