"""The base of effects: what calls for one, how it is built, and its hooks.

`Setup`, from which effects are built, and what they are told of a step are imported here too, for
effects of one's own.
"""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar, Self

from nmm.effects.given.setup import Setup as Setup
from nmm.effects.given.setup import StageLoads as StageLoads
from nmm.effects.given.steps import Instant as Instant
from nmm.effects.given.steps import Span as Span
from nmm.effects.given.steps import StepForce as StepForce
from nmm.effects.hooks.course import CourseHooks
from nmm.effects.hooks.energies import EnergyHooks
from nmm.effects.hooks.exchange import ExchangeHooks
from nmm.effects.hooks.forces import ForceHooks
from nmm.effects.hooks.reports import ReportHooks
from nmm.scene.fields import Frozen

if TYPE_CHECKING:
    from nmm.effects.change import Change


# Hooks by which an effect adds to the stress.
STRESSES = ("mean_stress", "stress_at")


class Effect(ForceHooks, EnergyHooks, ExchangeHooks, ReportHooks, CourseHooks, ABC):
    """Base of effects: override the hooks that the effect has; the others are never called.

    An effect of one's own is named by ``[effects.NAME]`` of a scene, whose keys its `Table`
    declares; the energy that it stores, or the work that it does, enters the balance of the run.

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
    whose reference configuration is updated."""
    external: bool = True
    """Whether its forces may change the momentum of all bodies together: false for pairs of
    forces, and for gravity, whose impulse is known to audits."""
    on_paths: ClassVar[bool] = False
    """Whether path following past a peak goes on through its changes of geometry, with its force
    independent of the load factor within a step."""
    stays: ClassVar[bool] = False
    """Whether it persists in stages whose scene does not name it."""

    @classmethod
    @abstractmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build the effect of a scene that calls for it."""

    def follow(self, change: "Change") -> "Effect":
        """Return the effect on the new model; by default it is built anew from the scene."""
        return type(self).from_setup(change.setup)

    @classmethod
    def in_place_of(cls, other: "Effect", change: "Change") -> "Effect":
        """Return the effect that continues ``other``, of the same name but another class.

        So it is where a dynamic stage follows a static one, or the other way round.
        """
        return cls.from_setup(change.setup)

    @classmethod
    def beyond_strain(cls) -> bool:
        """Whether with it tractions at held edges are not those of the strain in statics alone.

        Nitsche's terms of finite strain know no others. By default it is what adds a stress.
        """
        return any(getattr(cls, hook) is not getattr(Effect, hook) for hook in STRESSES)

    @property
    def resolves(self) -> float | None:
        """Shortest interval between samples of its input that steps resolve (s); None for none."""
        return None

    @property
    def turns_with_bodies(self) -> str:
        """What of it turns with the axes of bodies instead of the material, in words.

        Finite strain, in which axes never turn, refuses it. Empty where nothing does.
        """
        return ""


def defines(effect: Effect, hook: str) -> bool:
    """Return whether an effect overrides ``hook``."""
    return getattr(type(effect), hook) is not getattr(Effect, hook)
