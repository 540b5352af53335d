"""Linear elasticity with three axes of symmetry, two of them in the plane."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.base import Law


@dataclass(frozen=True)
class Orthotropic(Law):
    """Hooke's law of wood, layered rock and masonry: axis 1, axis 2, and 3 out of the plane.

    Attributes
    ----------
    young_modulus, poisson_ratio
        Of axis 1 (Pa): pulled along it, matter contracts by the ratio along axis 2.
    young_modulus_2
        Of axis 2 (Pa).
    shear_modulus
        Between them (Pa).
    axis_angle
        Of axis 1 from x, counter-clockwise (rad).
    young_modulus_3, poisson_ratio_13, poisson_ratio_23
        Of axis 3, and its contractions under pull along 1 and 2; those of axis 2 and of
        ``poisson_ratio`` if not given. They act in plane strain.
    """

    young_modulus: float
    poisson_ratio: float
    young_modulus_2: float
    shear_modulus: float
    axis_angle: float = 0.0
    young_modulus_3: float | None = None
    poisson_ratio_13: float | None = None
    poisson_ratio_23: float | None = None

    def __post_init__(self) -> None:
        least = np.linalg.eigvalsh(self._compliance())[0]
        if not (least > 0 and self.shear_modulus > 0):
            raise FormulationError(
                f"poisson_ratio: {self.poisson_ratio}: expected moduli and ratios whose energy is "
                "positive, |nu_12| < sqrt(E_1 / E_2) among others: lower the ratios"
            )

    def stiffness(self, plane: str) -> Floats:
        """See `Law.stiffness`; the matrix of the axes, turned."""
        solid = self._compliance()
        flat = solid[:2, :2]
        if plane == "strain":
            flat = flat - np.outer(solid[:2, 2], solid[2, :2]) / solid[2, 2]
        own, turn = np.zeros((3, 3)), self._turn
        own[:2, :2], own[2, 2] = np.linalg.inv(flat), self.shear_modulus
        whole = turn.T @ own @ turn
        return np.asarray((whole + whole.T) / 2)

    def free_strain(self, plane: str) -> Floats:
        """See `Law.free_strain`: restraint along axis 3 adds strains by its ratios."""
        solid, own = self._compliance(), np.array([1.0, 1.0, 0.0])
        if plane == "strain":
            own[:2] -= solid[:2, 2] / solid[2, 2]
        return np.asarray(np.linalg.solve(self._turn, own))

    @property
    def modulus(self) -> float:
        """The larger of Young's moduli in the plane (Pa)."""
        return max(self.young_modulus, self.young_modulus_2)

    @property
    def modulus_across(self) -> float:
        """Young's modulus of axis 3 (Pa)."""
        third = self.young_modulus_3
        return self.young_modulus_2 if third is None else third

    def pore_share(self, plane: str) -> Floats:
        """See `Law.pore_share`: reduced by the contraction due to free expansion along axis 3."""
        own = np.array([1.0, 1.0, 0.0])
        if plane == "stress":
            solid = np.linalg.inv(self._compliance())
            own[:2] -= solid[:2, 2] / solid[2, 2]
        return np.asarray(self._turn.T @ own)

    @property
    def _turn(self) -> Floats:
        """Matrix (3, 3) from strains (xx, yy, 2 xy) to those along the axes."""
        c, s = np.cos(self.axis_angle), np.sin(self.axis_angle)
        return np.array(
            [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]]
        )

    def _compliance(self) -> Floats:
        """Return strains (3,) along the axes from stresses along them (1/Pa)."""
        across = [
            self.poisson_ratio if given is None else given
            for given in (self.poisson_ratio_13, self.poisson_ratio_23)
        ]
        found = np.diag([1 / self.young_modulus, 1 / self.young_modulus_2, 1 / self.modulus_across])
        found[0, 1] = found[1, 0] = -self.poisson_ratio / self.young_modulus
        found[0, 2] = found[2, 0] = -across[0] / self.young_modulus
        found[1, 2] = found[2, 1] = -across[1] / self.young_modulus_2
        return found
