"""Which bonds Nitsche's consistent terms can hold, and their tractions as rows of the unknowns.

A bond that is whole is no spring: the traction on it is the average of both sides' plus a penalty
on the jump, ``t = {t} - gamma [u]``, and the terms are symmetric (Nitsche 1971). Where the traction
meets the criterion the bond passes to its cohesive or brittle law (Mergheim, Kuhl and Steinmann
2004; Noels and Radovitzky 2008).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from covers.approximation.rows import row_matrix
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import clockwise
from integration.sparse import csr_array, diags_array
from nmm.assembly.model import Model
from nmm.assembly.state import Frames, State
from nmm.assembly.stress_points import StressAt
from nmm.assembly.tractions.average import AverageTraction
from nmm.assembly.tractions.donors import Flux, added_traction, in_global_axes
from nmm.assembly.tractions.held_edges import HeldEdge
from nmm.contact.bonds.turning import turning_share
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import TIED, ContactPoints
from nmm.errors import FormulationError

# Multiples of the least penalty with which the form is positive, as between bodies that are glued.
SAFETY = 1.5


@dataclass(frozen=True)
class ConsistentBonds:
    """Points of joints that are bonded at the start.

    Attributes
    ----------
    number
        (m,) row below of the joint point with the key ``-1 - k``; -1 of those without.
    fluxes
        Tractions on the sides a that either side gives, times its weight.
    penalty
        (k,) Pa/m; zero where neither side has strain.
    share
        (k,) of it that holds what turns the sides of a joint against each other (`turning`).
    area
        (k,) that each point stands for (m2).
    mixed
        Which (k,) have their law in the mixed form (`nmm.contact.solution.mixed_bonds`), and are
        not tied.
    n_unknowns
        Of the model.
    """

    number: Ints
    fluxes: tuple[Flux, ...]
    penalty: Floats
    share: Floats
    area: Floats
    mixed: Bools
    n_unknowns: int

    @classmethod
    def of(
        cls,
        model: Model,
        joints: ContactPoints,
        laws: ContactLaws,
        seamless: Bools,
        acted: tuple[Bools, Bools] | None = None,
    ) -> Self | None:
        """Find the tractions on bonds where they lie at the start; None where springs hold all.

        Laws with a stiffness of their own keep it. Where matter is ``seamless`` (m,) across a bond
        that softens, its law acts in the mixed form. Something else acts on faces that are
        ``acted`` (m,) on, for each side; None where nothing does.
        """
        wanted = joints.bonded & ~laws.has_stiffness[joints.interface]
        if not laws.consistent or not wanted.any():
            return None
        points, number = joints.take(wanted), np.where(wanted, np.cumsum(wanted) - 1, -1)
        edges, area = model.manifold.boundary, points.length * model.thickness
        places = [edges.at(*side) for side in points.sides]
        elements = [edges.element[edge] for edge, _ in points.sides]
        reach = [_reach(model, own, points, area) for own in elements]
        sides = None if acted is None else [one[wanted] for one in acted]
        found = AverageTraction.of(model, elements, places, -points.normal, area, reach, sides)
        penalty = SAFETY * found.least
        bending = float(model.modulus.max()) * points.spring_factor / points.length
        rows = [(one.unknowns, one.values) for one in found.fluxes]
        share = turning_share(points, rows, penalty, bending)
        mixed = seamless[wanted] & ~laws.brittle[points.interface] & (penalty > 0)
        return cls(number, found.fluxes, penalty, share, area, mixed, model.manifold.n_unknowns)

    def tied(self, joints: ContactPoints, laws: ContactLaws) -> ContactPoints:
        """Return the joint points with the bonds that these terms hold, as stiff as the penalty.

        Where neither side has strain there is no traction: springs hold such a bond.
        """
        row = self.row(joints)
        held = (row >= 0) & (self.penalty[row] > 0)
        tied = held & ~self.mixed[row]
        # The softer spring of a mixed bond has all of the penalty.
        least = min(laws.normal_bond, laws.shear_bond)
        unit = np.where(tied, laws.normal_bond, least)
        factor = self.penalty[row] * self.area[row] / unit
        return replace(
            joints,
            spring_factor=np.where(held, factor, joints.spring_factor),
            history={**joints.history, TIED: np.where(tied, self.share[row], 0.0)},
        )

    def mixed_among(self, contacts: ContactPoints) -> Bools:
        """Return which contacts (m,) have their law in the mixed form."""
        found = contacts.is_joint
        row = self.number[-1 - contacts.key[found]]
        found[found] = (row >= 0) & self.mixed[row]
        return found

    def row(self, joints: ContactPoints) -> Ints:
        """Return the row of joint points, -1 of those without."""
        return self.number[-1 - joints.key]

    def held(
        self,
        bonds: ContactPoints,
        frames: Frames,
        moves: Callable[[], tuple[csr_array, csr_array]],
    ) -> HeldEdge:
        """Return whole bonds (k,) as points of an edge; ``moves`` are rows of gaps and slips."""
        row, across = self.row(bonds), bonds.normal
        along = clockwise(across)
        jump = bonds.gap[:, None] * across + bonds.slip[:, None] * along

        def rows() -> tuple[csr_array, csr_array]:
            gaps, slips = moves()
            x, y = (
                csr_array(diags_array(across[:, i]) @ gaps + diags_array(along[:, i]) @ slips)
                for i in (0, 1)
            )
            return x, y

        return HeldEdge(self.fluxes, frames, self.area[row], jump, rows, row)

    def averages(
        self,
        contacts: ContactPoints,
        state: State,
        stresses: Sequence[StressAt],
        time: float | None,
    ) -> tuple[tuple[Floats, csr_array], tuple[Floats, csr_array]]:
        """Average pull and shear at joint points, as gaps and slips go: (k,) in N, and rows (k, n).

        ``stresses`` are added by effects to those of the strain, as they are at a ``time`` (s),
        that of the state if None.
        """
        row, time = self.row(contacts), state.time if time is None else time
        unknowns, values = in_global_axes(self.fluxes, state.frames, row)
        values = values * self.area[row, None, None]
        added = -added_traction(self.fluxes, state.frames, stresses, time, row)
        added = added * self.area[row, None]
        normal, shear = (
            (
                row_matrix(unknowns, -np.einsum("kc,kcl->kl", axis, values), self.n_unknowns, True),
                np.einsum("kc,kc->k", axis, added),
            )
            for axis in (contacts.normal, clockwise(contacts.normal))
        )
        pull, drag = (rows @ state.deformation + more for rows, more in (normal, shear))
        return (pull, normal[0]), (drag, shear[0])


def consistent(model: Model, asked: str) -> bool:
    """Return whether consistent terms hold whole bonds: where requested, or where possible.

    Raises
    ------
    FormulationError
        Where they are requested for a material whose traction they do not know.
    """
    known = model.matter is None and not model.projected
    if asked == "nitsche" and not known:
        raise FormulationError(
            f'[contact] bonds: "nitsche": with {model.bent}, or projected volumes: '
            'expected linear materials: use bonds = "spring"'
        )
    return known and asked != "spring"


def _reach(model: Model, elements: Ints, points: ContactPoints, area: Floats) -> Floats:
    """Return how far (m,) the middles of elements are from the joints at their edges (m).

    At least half of the mean over all joints of an element: the middle of a hollow one may lie
    behind an edge.
    """
    middle = model.manifold.elements.centroids
    place = model.manifold.boundary.at(points.edge_a, points.parameter_a)
    far = np.abs(np.einsum("ij,ij->i", middle[elements] - place, points.normal))
    whole = np.bincount(elements, area)
    mean = np.bincount(elements, area * far) / np.where(whole > 0, whole, 1.0)
    return np.asarray(np.maximum(far, mean[elements] / 2))
