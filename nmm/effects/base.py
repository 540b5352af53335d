"""What an effect is to the step loop.

What it is built from (`Setup`) and what it is told of a step are to be had here too, for effects of
one's own.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Self

from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats, Ints
from nmm.assembly.applied_forces import AppliedForces, AppliedForcesIn
from nmm.assembly.motion import State
from nmm.assembly.stress_points import PressureAt, StressAt
from nmm.effects.given.setup import Setup as Setup
from nmm.effects.given.setup import StageLoads as StageLoads
from nmm.effects.given.steps import Instant as Instant
from nmm.effects.given.steps import Span as Span
from nmm.effects.given.steps import StepForce as StepForce
from nmm.quantity import MemberSegments, Quantity
from nmm.scene.fields import Frozen

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.event import Event
    from nmm.effects.motion.reactions import Reactions
    from nmm.effects.view import View


class Effect(ABC):
    """Base of effects: override the hooks the effect has; those left alone are never called.

    All vectors and matrices are in the unknowns of the step, that is in the bodies' axes. An
    effect of one's own is named by ``[effects.NAME]`` of a scene, whose keys its `Table` declares;
    what it stores, or the work that it does, joins the energies of the run.

    Attributes
    ----------
    name
        Of a built-in effect; one of one's own has the name of its table.
    Table
        Keys of the table of an effect of one's own.
    """

    name: ClassVar[str]
    Table: ClassVar[type[Frozen]] = Frozen
    placed: ClassVar[bool] = True
    """Whether places in the reference configuration declare it, so that it cannot follow bodies
    that are laid anew elsewhere."""
    external: bool = True
    """Whether its forces may change the momentum of all bodies together; false where they come in
    pairs, and for gravity, whose impulse audits know."""
    on_paths: ClassVar[bool] = False
    """Whether paths past the peak may go on through the changes that it asks for, and count its
    force through their steps, whatever their load factor is."""
    stays: ClassVar[bool] = False
    """Whether it goes on in stages whose scene no longer names it."""

    @classmethod
    @abstractmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build the effect of a scene that names it."""

    @property
    def about(self) -> str:
        """How the formulation imposes the effect, in words; empty where it has no choice."""
        return ""

    @property
    def caution(self) -> str:
        """What is known to spoil answers of it on this model, in words; empty where nothing is."""
        return ""

    @property
    def resolves(self) -> float | None:
        """Shortest time between samples of what drives it, that steps resolve (s); None is none."""
        return None

    @property
    def turns_with_bodies(self) -> str:
        """What of it turns with the axes of bodies, in words, and not with the material.

        Finite strain, whose axes never turn, refuses it. Empty where nothing does.
        """
        return ""

    @property
    def steady(self) -> bool:
        """Whether the force depends on the state alone and not on the instant, in dynamics."""
        return True

    def force(self, state: State, end: Instant) -> Floats:
        """Force (n,) that acts through the step."""
        raise NotImplementedError

    def matrix(self, state: State) -> csc_array:
        """Symmetric matrix (n, n) that joins the stiffness in the step that starts at ``state``."""
        raise NotImplementedError

    def damping(self, state: State) -> csc_array:
        """Symmetric matrix (n, n) of the force against the velocity, in steps in time alone.

        The step takes the force with the weights of elastic ones, and books what it takes.
        """
        raise NotImplementedError

    def added_mass(self, state: State) -> csc_array:
        """Symmetric matrix (n, n) by which the mass resists more in the step.

        It moves nothing by itself and stores no energy: what it takes or gives is booked as lost.
        """
        raise NotImplementedError

    @property
    def nonlinear(self) -> bool:
        """Whether `through` gives more than the line of `force` and `matrix`."""
        return True

    @property
    def limited(self) -> bool:
        """Whether its forces have limits, beyond which its matrix does not show what it carries."""
        return False

    @property
    def symmetric(self) -> bool:
        """Whether the matrix of `through` is; of others contact takes the symmetric part."""
        return True

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """Return the weighed force through a step from one state to a trial of its end.

        It stands for `force` and `matrix`, which are its line at the start; ``after`` has the
        memory of ``before``.

        Raises
        ------
        SolveError
            When there is none; the step is then cut.
        """
        raise NotImplementedError

    def work_correction(self, before: State, after: State, increment: Floats, span: Span) -> float:
        """Work (J) that its forces, as they rise, seem to do on the increment, less what they do.

        They do it on the way that its points went.
        """
        raise NotImplementedError

    def border(self, state: State, end: Instant) -> tuple[csr_array, Floats] | None:
        """Conditions ``rows @ d = sides`` on the step's unknowns (k, n); None without any."""
        raise NotImplementedError

    def keep(self, multipliers: Floats) -> Floats:
        """Take the first of the multipliers: those of these conditions; return the others."""
        raise NotImplementedError

    def work(self, before: State, after: State) -> float:
        """Work (J) that the effect did on the bodies in an accepted step."""
        raise NotImplementedError

    def first_work(self, before: State, after: State) -> float:
        """Work (J) that `work` lacks in the first step of statics; to be asked ahead of it.

        Nothing acts before that step: what acts at its start grows from nothing in it.
        """
        raise NotImplementedError

    def energy(self, state: State) -> float:
        """Energy (J) the effect stores."""
        raise NotImplementedError

    def loss(self, before: State, after: State) -> float:
        """Energy (J) that the effect took for good in an accepted step."""
        raise NotImplementedError

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Quantities of a state by name, for frames, run folders, ParaView and plots."""
        raise NotImplementedError

    def segments(self, state: State) -> MemberSegments:
        """Members as segments with what they carry, for frames, ParaView and plots."""
        raise NotImplementedError

    def history(self, state: State) -> Mapping[str, float]:
        """Numbers of a state by name, for a line of the history; asked for after each step."""
        raise NotImplementedError

    def mean_stress(self, state: State) -> Floats:
        """Stress (E, 3) in body axes that it adds to that of the strain, mean of the elements."""
        raise NotImplementedError

    def swelling(self, state: State, end: Instant) -> Floats | None:
        """Strain (Q,) of material points at the end of a step from a state, free of stress.

        It is alike in all three directions, and laws that are not linear are asked with it; None
        where nothing swells. What it does to other elements is a matter of `force`.
        """
        raise NotImplementedError

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """The same (m, 3) at reference points of elements, at a time."""
        raise NotImplementedError

    def pore_pressure_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """Pressure (m,) in Pa of what fills the pores, at reference points of elements."""
        raise NotImplementedError

    def receive_pore_pressures(self, pressures: Sequence[PressureAt]) -> None:
        """Take the `pore_pressure_at` of the other effects: it bears on strength."""
        raise NotImplementedError

    def receive_stresses(self, stresses: Sequence[StressAt]) -> None:
        """Take the `stress_at` of the other effects: what holds edges by tractions needs them."""
        raise NotImplementedError

    def applied_forces(self, state: State) -> AppliedForces:
        """Return the forces that it exerts within bodies and on faces of cracks, weight apart.

        Stress intensities count them; the rest of the boundary they know by the stress there.
        """
        raise NotImplementedError

    def receive_forces(self, forces: Sequence[AppliedForcesIn]) -> None:
        """Take the `applied_forces` of the other effects."""
        raise NotImplementedError

    def received_stress_energy(self, state: State) -> float:
        """The part (J) of its energy that is of the stresses that it feels."""
        raise NotImplementedError

    def imbalance(self, state: State) -> float:
        """What a conserved quantity lacks, as a share of all that came and went."""
        raise NotImplementedError

    def gap_volume(self, state: State, k: int) -> Floats:
        """Volumes (k,) left open at edges that the effect holds, for a model's k pressures (m2)."""
        raise NotImplementedError

    def accepted(self, state: State) -> None:
        """Take the end of an accepted step, before events are asked for.

        What the effect remembers of it it hands over by `carried`.
        """
        raise NotImplementedError

    def event(self, view: "View") -> "Event | None":
        """Return the change that an accepted state calls for; None where all stays as it is.

        It is asked after every accepted step, once at an instant, and must leave the effect as it
        was: a step that ends beyond the event may be taken again with a smaller increment. What
        the effect remembers of the change it learns in `follow`, and hands over by `carried`.
        """
        raise NotImplementedError

    def follow(self, change: "Change") -> "Effect":
        """Return the effect on the new model: built anew from what declares it."""
        return type(self).from_setup(change.setup)

    @classmethod
    def in_place_of(cls, other: "Effect", change: "Change") -> "Effect":
        """Return what goes on for ``other``, of this name but of another kind.

        It is of a stage in time for one at rest, or the other way round; built from what
        declares it.
        """
        return cls.from_setup(change.setup)

    def begin(self, state: State) -> State:
        """Return the state at the start of the run as the effect changes it."""
        raise NotImplementedError

    def join_run(self, state: State) -> None:
        """Take the state in which the effect joins a run that has begun without it."""
        raise NotImplementedError

    def take_over(self, left: "Sequence[Reactions]") -> None:
        """Take what supports exerted that the change takes away, ready to act on the new model."""
        raise NotImplementedError

    def receive_residual(self, change: "Change", force: Floats) -> None:
        """Take what is out of balance as a change begins to act, a force (n,) on the new model."""
        raise NotImplementedError

    def carried(self) -> Any:
        """What the effect carries from accepted step to accepted step besides the bodies' state.

        It is stored in checkpoints: arrays, numbers, texts, None, and tuples and mappings of these
        by name, or dataclasses of them that `nmm.results.storage.values` knows.
        """
        raise NotImplementedError

    def carry(self, carried: Any) -> None:
        """Take back what `carried` returned."""
        raise NotImplementedError

    def forget(self) -> None:
        """Drop what is kept for speed alone; answers stay as they are within their tolerance."""
        raise NotImplementedError


def defines(effect: Effect, hook: str) -> bool:
    """Say whether an effect has its own ``hook``."""
    return getattr(type(effect), hook) is not getattr(Effect, hook)
