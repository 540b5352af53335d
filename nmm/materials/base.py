"""What a material law is to the rest of the program."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.registry import Registry

History = Mapping[str, Floats]
"""Internal variables of material points by name, each (m, h)."""


class Response(NamedTuple):
    """What a law answers at m material points.

    Attributes
    ----------
    stress
        (m, 3) Pa: xx, yy, xy.
    tangent
        (m, 3, 3) derivative of the stress by the strain (Pa).
    history
        Internal variables after the step, those that `Law.variables` names.
    """

    stress: Floats
    tangent: Floats
    history: History


class FiniteResponse(NamedTuple):
    """What a law answers at m Green strains.

    Attributes
    ----------
    energy
        (m,) J/m3 of the volume as it was.
    stress
        (m, 3) second Piola-Kirchhoff stress (Pa): xx, yy, xy.
    tangent
        (m, 3, 3) its derivative by the Green strain (xx, yy, 2 xy), Pa.
    """

    energy: Floats
    stress: Floats
    tangent: Floats


@dataclass(frozen=True)
class Law(ABC):
    """Base of stress-strain laws; a frozen set of parameters in SI units.

    A linear law defines `stiffness` alone. One that remembers or bends defines `update` and
    `variables` as well; its `stiffness` is then the elastic one, the unit of penalties and of
    the first iteration. ``plane`` is "stress" or "strain" everywhere.
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
        """Whether tangents are symmetric, as where flow follows from the yield surface itself."""
        return True

    @property
    def rests(self) -> bool:
        """Whether a step without strain leaves points as they are and elastic, whatever it lasts.

        Iterations then begin there without asking the law; where they end it is asked.
        """
        return False

    @property
    def swells(self) -> bool:
        """Whether it takes ``swelling`` (m, 1) of the history where matter is heated.

        That is the strain at the end of the step, alike in all three directions, that is free of
        stress.
        """
        return False

    @property
    def sized(self) -> bool:
        """Whether answers hang on the size of cells: ``cell_size`` (m, 1) in m of the history.

        Strain that localises does so in one row of cells: what it takes for the area of the band is
        what its law takes for the volume times the size of the cell (Bazant and Oh 1983).
        """
        return False

    def check_size(self, size: Floats) -> None:
        """Refuse cells of sizes (m,) in m with which the law has no answer.

        Raises
        ------
        FormulationError
            Naming the largest that it has one with.
        """
        return None

    def variables(self, plane: str) -> History:
        """Return the internal variables of one point at the start, (h,) each."""
        return {}

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        """Return stress, tangent and internal variables at the end of a step.

        It is asked many times in a step, always with the variables of its start: a law keeps
        nothing by itself.

        Parameters
        ----------
        strain
            (m, 3) whole strain at the end of the step (xx, yy, 2 xy), not its increment.
        history
            Internal variables at the start of the step.
        step
            Length of the step (s); 0 in statics, where no time passes.
        """
        matrix = self.stiffness(plane)
        return Response(strain @ matrix.T, np.tile(matrix, (len(strain), 1, 1)), history)

    def under(self, strain: Floats, stress: Floats, across: Floats) -> History:
        """Return the variables that make a stress (m, 3) and ``across`` (m,) of a strain (m, 3).

        Laws that know of no stress across return nothing.
        """
        return {}

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return the stored energy (m,) in J/m3 at a stress (m, 3) with internal variables.

        What work leaves beyond it counts as dissipated. Here it is that of the elastic strain by
        the plane `stiffness`.
        """
        elastic = stress @ np.linalg.inv(self.stiffness(plane))
        return np.asarray((elastic * stress).sum(axis=1) / 2)

    def potential(self, strain: Floats, plane: str) -> FiniteResponse:
        """Return energy, stress and tangent at Green strains (m, 3), for finite strain.

        Of a linear law it is that of St Venant and Kirchhoff: `stiffness` between the Green strain
        ``(F^T F - 1) / 2`` and the second Piola-Kirchhoff stress.

        Raises
        ------
        FormulationError
            Of laws that remember: they have no potential.
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
        """Return Kolosov's constant of singular fields; None of laws whose fields are others.

        ``(3 - nu) / (1 + nu)`` in plane stress, ``3 - 4 nu`` in plane strain.
        """
        return None

    def free_strain(self, plane: str) -> Floats:
        """Return the strain (3,) in the plane of free matter that swells by 1 in all directions.

        In plane strain it is larger, as the third direction is held (Timoshenko and Goodier 1951).
        Here it is that of a `stiffness` alike in all directions, by ``1 + nu``; a linear law that
        has axes defines its own.
        """
        held = 0.0
        if plane == "strain":
            along, across = self.stiffness(plane)[0, :2]
            held = float(across / (along + across))
        return np.array([1 + held, 1 + held, 0.0])

    def pore_share(self, plane: str) -> Floats:
        """Return the stress (3,) in the plane that a pressure of 1 in all its pores takes.

        In plane strain it is 1 itself. In plane stress, where what the pores press across widens
        matter freely, it is less by what that contracts in the plane: ``(1 - 2 nu) / (1 - nu)`` of
        a `stiffness` alike in all directions; a linear law that has axes defines its own.
        """
        share = 1.0
        if plane == "stress":
            along, across = self.stiffness(plane)[0, :2]
            share = float((along - 2 * across) / (along - across))
        return np.array([share, share, 0.0])

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
