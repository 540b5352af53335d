"""The base class of interface laws: limits of force, internal variables, failure of bonds."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, final

import numpy as np

from integration.arrays import Bools, Floats
from nmm.interfaces.history import CUMULATIVE_SLIP, KEPT, History, HistoryColumn
from nmm.interfaces.passage import Passage
from nmm.interfaces.response import InterfaceResponse, Traction
from nmm.interfaces.return_mapping import mapped
from nmm.registry import Registry


@dataclass(frozen=True)
class InterfaceLaw(ABC):
    """Base of interface laws; a frozen set of parameters in SI units.

    A law gives the response at a fixed history (`response`) and the history after a step
    (`evolved`); the contact solution is repeated until both agree. `update` is both together at a
    point.

    Attributes
    ----------
    friction_angle
        rad.
    cohesion, tensile_strength
        Pa.
    bonded
        Whether strength acts from the start and is lost for good at the first failure.
    normal_stiffness, shear_stiffness
        Pa/m of the joint itself; None leaves a numerical penalty.
    fracture_energy, shear_fracture_energy
        J/m2 of an opening and of a sliding bond; None is brittle, or for shear the same as opening.
    residual_friction_angle
        rad, where a bond is broken; None is ``friction_angle``.
    dilation_angle
        rad: sliding by ``s`` lifts the faces apart by ``s tan(dilation_angle)``.
    dilation_slip
        m of sliding after which dilation ends.
    damping
        Share of critical damping of the normal spring while it is pressed, >= 0.
    """

    friction_angle: float
    cohesion: float = 0.0
    tensile_strength: float = 0.0
    bonded: bool = False
    normal_stiffness: float | None = None
    shear_stiffness: float | None = None
    fracture_energy: float | None = None
    shear_fracture_energy: float | None = None
    residual_friction_angle: float | None = None
    dilation_angle: float = 0.0
    dilation_slip: float = float("inf")
    damping: float = 0.0

    softened: ClassVar[str] = ""
    """Name of the law that a scene means by this one where it gives a fracture energy; laws derived
    from this one are meant as they are."""

    @property
    def columns(self) -> Mapping[str, HistoryColumn]:
        """Internal variables of a contact besides its bond and its plastic slip."""
        return {"cumulative_slip": CUMULATIVE_SLIP} if self.dilation_angle else {}

    @property
    def makes_joints(self) -> bool:
        """Whether shared edges are followed as joints from the start."""
        return self.bonded or self.cohesion > 0 or self.normal_stiffness is not None

    @property
    def least_stiffness(self) -> float:
        """Normal stiffness (Pa/m) that springs of its bonds must exceed."""
        return 0.0

    @abstractmethod
    def response(self, history: History, stiffness: Floats) -> InterfaceResponse:
        """Return springs and limits of contacts at a fixed ``history``.

        They depend on bonds and on the law's own `columns`, not on the plastic slip.
        ``stiffness`` (m,) is the normal stiffness of undamaged bonds (Pa/m).
        """

    def evolved(
        self, history: History, gap: Floats, sliding: Floats, stiffness: Floats
    ) -> dict[str, Floats]:
        """Return the history after a step.

        Parameters
        ----------
        history
            At the start of the step.
        gap
            (m,) at the end of it, elastic part and crack (m).
        sliding
            (m,) increment of the plastic slip, with its sign (m).
        stiffness
            (m,) normal stiffness of undamaged bonds (Pa/m).
        """
        after = dict(history) | {"plastic_slip": history["plastic_slip"] + sliding}
        if "cumulative_slip" in self.columns:
            after["cumulative_slip"] = history["cumulative_slip"] + np.abs(sliding)
        return after

    def dissipated(self, passage: Passage) -> Floats:
        """Return the energy (m,) that softening bonds dissipated in a step (J/m2).

        By default it is `dissipated_by_means`, which is right for short steps. A law that knows its
        dissipation from the history overrides it.
        """
        return self.dissipated_by_means(passage)

    @final
    def dissipated_by_means(self, passage: Passage) -> Floats:
        """Return the work (m,) of the mean tractions in a step less the stored energy (J/m2).

        It balances the work of mean loads, whatever they were within the step.
        """
        lifts = [self.rise(history) for history in passage.history]
        work = sum(passage.pull) / 2 * (passage.gap[1] - passage.gap[0])
        slipped = passage.slip[1] - passage.slip[0] + passage.sliding
        work = work + sum(passage.shear) / 2 * slipped
        for sign, pull, shear, gap, slip, lift in zip(
            (1, -1), passage.pull, passage.shear, passage.gap, passage.slip, lifts, strict=True
        ):
            work = work + sign * (pull * (gap - lift) + shear * slip) / 2
        return np.asarray(work)

    def overload(self, pull: Floats, shear: Floats) -> Floats:
        """Return stress over strength (m,) of intact bonds (Pa); above 1 a bond breaks at once."""
        return np.zeros(len(pull))

    def onset(self, pull: Floats, shear: Floats) -> Floats:
        """Return stress over strength (m,) of undamaged bonds that have no spring of the law's own.

        Above 1 such a bond breaks at once, or begins to soften.
        """
        return self.overload(pull, shear)

    @final
    def update(
        self, history: History, gap: Floats, slip: Floats, stiffness: tuple[Floats, Floats]
    ) -> Traction:
        """Return traction, tangent and history after a gap (m,) and a slip (m,) in m.

        ``slip`` counts from where the contact began; ``stiffness`` (Pa/m) of normal and shear
        spring: the law's own, or that of the formulation's bonds.
        """
        return mapped(self, history, gap, slip, stiffness)

    @final
    def initial(self, bonded: Bools) -> dict[str, Floats]:
        """Return the initial history (m,) of contacts with a bond, or without."""
        return {
            name: np.where(bonded, column.bonded, column.unbonded).astype(
                bool if name == "bonded" else float
            )
            for name, column in (KEPT | dict(self.columns)).items()
        }

    @final
    def broken(self, history: History) -> dict[str, Floats]:
        """Return the history (m,) of bonds that broke at once."""
        unbonded = self.initial(np.zeros(len(history["bonded"]), dtype=bool))
        lost = {name for name, column in self.columns.items() if column.unbonded != column.bonded}
        return dict(history) | {name: unbonded[name] for name in ("bonded", *lost)}

    def friction(self, history: History) -> Floats:
        """Return the tangent (m,) of the friction angle: residual where the bond is broken."""
        intact = history["bonded"] | (not self.bonded)
        return np.asarray(
            np.where(intact, np.tan(self.friction_angle), np.tan(self.residual_angle))
        )

    def rise(self, history: History) -> Floats:
        """Return the opening (m,) by dilation, in m."""
        if not self.dilation_angle:
            return np.zeros(len(history["bonded"]))
        lifting = np.minimum(history["cumulative_slip"], self.dilation_slip)
        return np.asarray(np.tan(self.dilation_angle) * lifting)

    @property
    def residual_angle(self) -> float:
        """Friction angle (rad) of broken bonds."""
        residual = self.residual_friction_angle
        return self.friction_angle if residual is None else residual


INTERFACE_LAWS = Registry[type[InterfaceLaw]](
    "interface law",
    InterfaceLaw,
    {
        "mohr_coulomb": "nmm.interfaces.mohr_coulomb:MohrCoulomb",
        "linear_softening": "nmm.interfaces.softening:LinearSoftening",
        "bilinear_softening": "nmm.interfaces.softening:BilinearSoftening",
        "exponential_softening": "nmm.interfaces.softening:ExponentialSoftening",
    },
)
