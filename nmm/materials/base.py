"""The base class of material laws, and those that formulations name."""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.law.across import AcrossThePlane
from nmm.materials.law.responses import FiniteResponse as FiniteResponse
from nmm.materials.law.responses import History as History
from nmm.materials.law.responses import Response as Response
from nmm.registry import Registry


@dataclass(frozen=True)
class Law(AcrossThePlane):
    """Base of stress-strain laws; a frozen set of parameters in SI units.

    A linear law defines `stiffness` alone. A law that is nonlinear or has internal variables
    defines `update` and `variables` as well; its `stiffness` is then the elastic one, used for
    penalties and in the first iteration. ``plane`` is "stress" or "strain" everywhere.
    """

    @abstractmethod
    def stiffness(self, plane: str) -> Floats:
        """Return the elastic matrix (3, 3) from strain (xx, yy, 2 xy) to stress (Pa)."""

    @property
    def linear(self) -> bool:
        """Whether stress is `stiffness` times strain, so that matrices are made once."""
        return type(self).update is Law.update

    @property
    def symmetric(self) -> bool:
        """Whether tangents are symmetric, as those of associated flow are."""
        return True

    @property
    def rests(self) -> bool:
        """Whether points stay elastic and unchanged in a step without strain, however long.

        Iterations then begin there without evaluating the law, which is evaluated where they end.
        """
        return False

    @property
    def swells(self) -> bool:
        """Whether the law reads thermal strain from the history, as ``swelling`` (m, 1).

        It is the stress-free strain at the end of the step, equal in all three directions.
        """
        return False

    @property
    def sized(self) -> bool:
        """Whether the response depends on the cell size: ``cell_size`` (m, 1) in m of the history.

        Strain localises in one row of cells: the energy per area of the band is that of the law per
        volume times the cell size (crack band model, Bazant and Oh 1983).
        """
        return False

    def check_size(self, size: Floats) -> None:
        """Refuse cells of sizes (m,) in m that are too large for the law.

        Raises
        ------
        FormulationError
            Naming the largest admissible size.
        """
        return None

    def size_share(self, size: Floats, pressure: Floats) -> Floats:
        """Return sizes (m,) of cells over the largest under a mean pressure (m,) in Pa.

        By default 0: `check_size` knows it all.
        """
        return np.zeros(len(size))

    def variables(self, plane: str) -> History:
        """Return the initial internal variables of one point, (h,) each."""
        return {}

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        """Return stress, tangent and internal variables at the end of a step.

        It is called many times in a step, always with the variables at its start: a law has no
        state of its own.

        Parameters
        ----------
        strain
            (m, 3) total strain at the end of the step (xx, yy, 2 xy), not its increment.
        history
            Internal variables at the start of the step.
        step
            Length of the step (s); 0 in statics, where no time passes.
        """
        matrix = self.stiffness(plane)
        return Response(strain @ matrix.T, np.tile(matrix, (len(strain), 1, 1)), history)

    def under(self, strain: Floats, stress: Floats, across: Floats) -> History:
        """Return the internal variables at which a strain (m, 3) gives a stress (m, 3).

        ``across`` (m,) is the stress out of the plane (Pa); laws without one return nothing.
        """
        return {}

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return the stored energy (m,) in J/m3 at a stress (m, 3) with internal variables.

        The rest of the work counts as dissipated. By default it is the energy of the elastic
        strain that follows from `stiffness`.
        """
        elastic = stress @ np.linalg.inv(self.stiffness(plane))
        return np.asarray((elastic * stress).sum(axis=1) / 2)

    def potential(self, strain: Floats, plane: str) -> FiniteResponse:
        """Return energy, stress and tangent at Green strains (m, 3), for finite strain.

        A linear law becomes that of St Venant and Kirchhoff: `stiffness` between the Green strain
        ``(F^T F - 1) / 2`` and the second Piola-Kirchhoff stress.

        Raises
        ------
        FormulationError
            For laws with internal variables, which have no potential.
        """
        if not self.linear:
            raise FormulationError(
                f'[rotation] update: "finite": the law {type(self).__name__} has no potential of '
                'finite strain: expected one that is elastic: use law = "elastic" or '
                '"neo_hookean", or update = "exact"'
            )
        matrix = self.stiffness(plane)
        stress = strain @ matrix.T
        tangent = np.broadcast_to(matrix, (len(strain), 3, 3))
        return FiniteResponse((stress * strain).sum(axis=1) / 2, stress, tangent)

    def kolosov(self, plane: str) -> float | None:
        """Return Kolosov's constant of singular fields; None for laws with other singular fields.

        ``(3 - nu) / (1 + nu)`` in plane stress, ``3 - 4 nu`` in plane strain.
        """
        return None

    @property
    @abstractmethod
    def modulus(self) -> float:
        """Young's modulus (Pa): the unit in which penalties are given."""


MATERIAL_LAWS = Registry[Callable[..., Law]](
    "material law",
    Law,
    {
        "burgers": "nmm.materials.viscous.laws:Burgers",
        "elastic": "nmm.materials.elastic:Elastic",
        "drucker_prager": "nmm.materials.drucker_prager:DruckerPragerPlasticity",
        "kelvin": "nmm.materials.viscous.laws:Kelvin",
        "maxwell": "nmm.materials.viscous.laws:Maxwell",
        "mohr_coulomb": "nmm.materials.mohr_coulomb:MohrCoulombPlasticity",
        "neo_hookean": "nmm.materials.neo_hookean:NeoHookean",
        "orthotropic": "nmm.materials.orthotropic:Orthotropic",
        "standard_solid": "nmm.materials.viscous.laws:StandardSolid",
        "von_mises": "nmm.materials.von_mises:VonMisesPlasticity",
    },
)
