"""The equations of one step but for contact: material, inertia, supports and loads.

Matter that is not linear enters by its `Linearisation` at an iterate of the step: the equations
stay linear in the whole increment, whatever the iterate.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.moving.spin import SpinOfStep
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.frozen import with_parts
from nmm.integrators.base import Integrator
from nmm.integrators.damping import Damping
from nmm.solvers.unchecked import product

if TYPE_CHECKING:
    from nmm.effects.inertia import Inertia

# Energy that a step may make, as a share of all there is, for spin and stretch that it foresaw.
FORESEEN = 1e-7


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
    spin
        What spin does to strained bodies through the step; None where no body turns.
    turned_less
        (n,) by how much less than by their spin they turn; None where none does.
    """

    mass: csc_array
    factor: float
    momentum: Floats
    rates: Floats
    outwards: Floats
    weight: float
    contact_factor: float
    gain: Floats | None
    applied: Floats | None = None
    damping: Damping | None = None
    elastic: csc_array | None = None
    spin: SpinOfStep | None = None
    turned_less: Floats | None = None


@dataclass(frozen=True)
class Carriage:
    """Bodies as driven ground has carried them before a step is solved for the way that is left.

    Attributes
    ----------
    state
        With the bodies there.
    way
        (n,) the unknowns of that motion.
    """

    state: State
    way: Floats


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
    carriage
        Where driven ground has carried bodies, from where ``d`` counts; None where nowhere.
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
    carriage: Carriage | None = None

    @property
    def origin(self) -> State:
        """Where the unknowns count from."""
        return self.state if self.carriage is None else self.carriage.state


def spinning(equations: Equations, inertia: "Inertia", end: State) -> Equations:
    """Return the equations with spins and stretches as they were found at an ``end``."""
    terms, step = equations.inertia, equations.step
    if terms is None or step is None:
        return equations
    spin = inertia.through(equations.state, step, equations.rule.kinetic_factor, end)
    if spin is None:
        return equations
    outwards, less = inertia.pull(spin), inertia.turned_less(spin, step)
    slower = less if terms.turned_less is None else less - terms.turned_less
    rates = terms.factor * slower
    momentum = product(terms.mass, rates)
    pushed = outwards - terms.outwards - momentum
    if terms.damping is not None:
        pushed -= sum(one @ rates for one in terms.damping.masses.values())
    turned = with_parts(
        terms,
        momentum=terms.momentum - momentum,
        rates=terms.rates - rates,
        outwards=outwards,
        spin=spin,
        turned_less=less,
    )
    force = equations.force + pushed / terms.contact_factor
    return with_parts(equations, force=force, inertia=turned)


def misjudged(equations: Equations, inertia: "Inertia", model: Model, end: State) -> bool:
    """Whether a step makes energy that counts, as it foresaw other spins and stretches."""
    terms = equations.inertia
    if terms is None:
        return False
    made, moving = inertia.misjudged(terms.spin, equations.state, end)
    return made > FORESEEN * moving and made > FORESEEN * (moving + model.strain_energy(end))
