"""Plastic laws with friction: their constants, bounds of these, and softening."""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from integration.arrays import Floats
from nmm.errors import Fault, FormulationError
from nmm.materials.base import History, Response
from nmm.materials.crack_band import SofteningPlasticity, check_residual
from nmm.materials.plasticity import flowed, grown
from nmm.materials.return_mapping.planes import (
    ActingPlanes,
    ReturnedStress,
    StrengthLoss,
    largest_cell,
)


@dataclass(frozen=True)
class Frictional(SofteningPlasticity):
    """Base of laws with cohesion and friction in plane strain, perfectly plastic or softening.

    Attributes
    ----------
    cohesion, friction_angle
        Pa; rad, below pi / 2. An angle of 0 leaves cohesion alone.
    dilation_angle
        From 0, no change of volume, to the friction angle (rad).
    tensile_strength
        Pa, below the tension ``c / tan phi`` at the apex; none cuts nothing off.
    softening_energy
        J/m2 that a band of flow takes for its area until its cohesion is the residual one, beyond
        what that and friction take; None is no softening.
    residual_cohesion
        Cohesion that is left (Pa); of the tensile strength, or of the apex, the same share is.
    residual_friction_angle, residual_dilation_angle
        Angles that are left with it (rad); None stays.

    Notes
    -----
    Internal variables: ``plastic_strain`` (4: xx, yy, 2 xy, zz), ``accumulated_plastic_strain``
    (the sum of ``sqrt(2/3 |de|^2)`` of its deviator), ``stress_zz`` (Pa), and where it softens
    ``softened``, the share of the fall that is done (`nmm.materials.return_mapping.planes`). Where
    the angles differ, or fall, the tangent is not symmetric.
    """

    cohesion: float
    friction_angle: float
    dilation_angle: float = 0.0
    tensile_strength: float | None = None
    residual_cohesion: float = field(default=0.0, kw_only=True)
    residual_friction_angle: float | None = field(default=None, kw_only=True)
    residual_dilation_angle: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        if not self.cohesion >= 0:
            raise FormulationError(
                f"cohesion: {self.cohesion}: expected a cohesion in Pa, >= 0: correct it"
            )
        if not 0 <= self.friction_angle < np.pi / 2:
            raise FormulationError(
                f"friction_angle: {self.friction_angle}: expected an angle in [0, pi/2) rad: "
                "correct it"
            )
        if self.cohesion == 0 and self.friction_angle == 0:
            raise FormulationError(
                "cohesion and friction_angle: 0: expected strength: raise one of them"
            )
        if not 0 <= self.dilation_angle <= self.friction_angle:
            raise FormulationError(
                f"dilation_angle: {self.dilation_angle}: expected an angle from 0 to the friction "
                f"angle of {self.friction_angle:.6g} rad: beyond it flow would give energy"
            )
        if self.tensile_strength is not None and not 0 <= self.tensile_strength <= self.apex:
            raise FormulationError(
                f"tensile_strength: {self.tensile_strength}: expected a stress from 0 to the apex "
                f"at c / tan(phi) = {self.apex:.6g} Pa, beyond which it never acts: lower it, or "
                "leave it out"
            )
        self._check_softening()

    def _check_softening(self) -> None:
        """Refuse constants with which the law cannot soften."""
        energy = self.softening_energy
        if energy is not None and not (energy > 0 and self.cohesion > 0):
            raise FormulationError(
                f"softening_energy: {energy}: expected an energy in J/m2, > 0, of a "
                "law with a cohesion that can fall: correct it, or raise cohesion"
            )
        left = "residual_cohesion", self.residual_cohesion
        check_residual(energy, left, self.cohesion, "a cohesion from 0 to below that")
        (friction, dilation), (last, swells) = self.angles
        for name, angle in (("friction", friction), ("dilation", dilation)):
            self._check_angle(f"residual_{name}_angle", angle)
        if swells > last:
            raise FormulationError(
                f"residual_dilation_angle: {swells:.6g}: expected an angle from 0 to the residual "
                f"friction angle of {last:.6g} rad: beyond it flow would give energy: lower it"
            )

    def _check_angle(self, name: str, most: float) -> None:
        """Refuse an angle that is left, by name, if nothing falls or it is more than ``most``."""
        left = getattr(self, name)
        if left is None:
            return
        if self.softening_energy is None:
            raise FormulationError(
                f"{name}: {left}: expected a law that softens: add softening_energy"
            )
        if not 0 <= left <= most:
            raise FormulationError(
                f"{name}: {left}: expected an angle from 0 to that which it falls from, "
                f"{most:.6g} rad: lower it"
            )

    @property
    def angles(self) -> Floats:
        """Angles (2, 2) of friction and of dilation, initial and fully softened."""
        first = self.friction_angle, self.dilation_angle
        left = self.residual_friction_angle, self.residual_dilation_angle
        last = [one if end is None else end for one, end in zip(first, left, strict=True)]
        return np.array([first, last])

    @property
    @abstractmethod
    def sets(self) -> Sequence[ActingPlanes]:
        """Sets of planes of the yield surface that may be active together."""

    @property
    def fall(self) -> float:
        """Share of the strengths that is lost when fully softened."""
        return 1 - self.residual_cohesion / self.cohesion if self.sized else 0.0

    def cell_limit(self, energy: float) -> tuple[float, str]:
        most, remedy = largest_cell(self.sets, energy), ""
        if self.tensile_strength is None:
            cut = replace(self, tensile_strength=min(self.cohesion, self.apex))
            if largest_cell(cut.sets, energy) > most:
                remedy = f", or give a tensile_strength below the apex of {self.apex:.4g} Pa"
        return most, remedy

    def size_share(self, size: Floats, pressure: Floats) -> Floats:
        """See `Law.size_share`: friction that falls takes strength as well, by the pressure.

        Of one plane of friction; at constant pressure points snap back from 1.17 to 1.7 on.
        """
        if self.softening_energy is None:
            return super().size_share(size, pressure)
        first, last = np.tan(self.angles[:, 0])
        taken = pressure.clip(0) * (first - last) / (self.cohesion - self.residual_cohesion)
        eased = self.sets[0].eased / 2 / self.softening_energy
        return np.asarray(size * eased * (1 + taken))

    def variables(self, plane: str) -> History:
        more = {"softened": np.zeros(1)} if self.sized else {}
        return {**super().variables(plane), **more}

    def weakening(self, history: History) -> StrengthLoss:
        """Return the loss of strength of points."""
        if self.softening_energy is None:
            return StrengthLoss.none(len(history["plastic_strain"]))
        speed = history["cell_size"][:, 0] / 2 / self.softening_energy
        return StrengthLoss(history["softened"][:, 0], speed)

    def answer(self, found: ReturnedStress, history: History) -> Response:
        """Return the response of points after the return to the yield surface."""
        accumulated = grown(history, found.plastic_strain)
        parts = found.stress, found.tangent, found.plastic_strain, accumulated
        response = flowed(history, *parts)
        if not self.sized:
            return response
        history = {**response.history, "softened": found.softened[:, None]}
        return response._replace(history=history)

    @property
    def apex(self) -> float:
        """Isotropic tension at the apex (Pa); infinite without friction."""
        tangent = float(np.tan(self.friction_angle))
        return self.cohesion / tangent if tangent else float("inf")

    @property
    def tension(self) -> float:
        """Largest isotropic tension (Pa): the tensile strength, or the apex."""
        return self.apex if self.tensile_strength is None else self.tensile_strength

    @property
    def symmetric(self) -> bool:
        """Whether flow is associated and the angles are constant."""
        return bool((self.angles == self.friction_angle).all())

    def stiffness(self, plane: str) -> Floats:
        """See `Law.stiffness`; plane stress is refused."""
        if plane == "stress":
            expected = '"strain": the stress across takes part in the yield'
            raise FormulationError(
                Fault("law", 'plane "stress"', expected, 'use "von_mises" in plane stress')
            )
        return super().stiffness(plane)
