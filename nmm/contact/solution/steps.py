"""Steps with contact: rows, bonds and averages over faces, put together and solved."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from nmm.assembly.state import State
from nmm.contact.detection.surface import Surface
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.mortar.face_means import FaceMeans
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.contact.points.half_way.mean_motion import Forces
from nmm.contact.problem.transform import Transform
from nmm.contact.solution.driver import ContactSolver
from nmm.contact.solution.geometry import ContactGeometry
from nmm.contact.solution.posed_step import moved_jumps
from nmm.contact.solution.record import ContactRecord, ContactSolution
from nmm.contact.solution.request import StepRequest
from nmm.contact.solution.step_bonds import StepBonds


@dataclass(frozen=True)
class ContactSteps:
    """What the contact problems of a model's steps are put together from.

    Attributes
    ----------
    laws, geometry, bonds, solver
        Interface laws, rows of points, bonds that consistent terms hold, and what solves.
    surface
        From a state to the boundary edges in their present place.
    """

    laws: ContactLaws
    geometry: ContactGeometry
    bonds: StepBonds
    solver: ContactSolver
    surface: Callable[[State], Surface]

    def solve(
        self,
        contacts: ContactPoints,
        state: State,
        request: StepRequest,
        midpoint: State | None = None,
        forces: Forces | None = None,
        end: State | None = None,
    ) -> ContactSolution:
        """Solve one step; forces act at ``midpoint``, at the start of the step when None.

        ``forces`` are those that are known to act there, see `ContactGeometry.rows`; ``end`` is the
        predicted end of the step, of bodies under finite strain.
        """
        alone = self.solver.alone(contacts, request)
        if alone is not None:
            return alone
        if end is None:
            rows = self.geometry.rows(contacts, state, midpoint, forces)
        else:
            rows = self.geometry.conserving(contacts, state, end)
        surface, space = self.surface(state), self.geometry.trace_space
        mixed, posed = self.bonds.posed(contacts, rows, request, state)

        def besides(present: ContactPoints) -> list[Transform]:
            gap, slip = moved_jumps(present, rows, request)
            there = present if request.carried is None else replace(present, gap=gap, slip=slip)
            tied = self.bonds.tied(there, state, rows, request.weight, request.time)
            free = present if tied is None else present.take(~present.tied)
            means = None if space is None else FaceMeans.of(free, surface, space)
            return [part for part in (tied, means, request.null_space) if part is not None]

        solved = self.solver.solve(*posed, besides)
        return solved if mixed is None else mixed.told(replace(solved, broken=None), contacts)

    def energy(
        self, record: ContactRecord, state: State, joints: Callable[[], ContactPoints], exact: bool
    ) -> float:
        """Energy of contacts as last committed (J): of springs, and of an enforcement's own.

        ``joints`` returns the joint points at present; ``exact`` contacts store no energy.
        """
        known = [] if record.known is None else [record.known]
        points = concatenate([record.book.points, *known])
        total, mixed = record.stored, self.bonds.mixed(points, state)
        if mixed is not None:
            points, total = mixed.stretched(points), total - mixed.energy
        points = concatenate([points, record.book.left])
        if points.gap.size:
            total += self.laws.energy(points, own_only=exact)
        if self.bonds.terms is None:
            return total
        now = joints()
        tied = self.bonds.tied(now, state, self.geometry.rows(now, state))
        return total if tied is None else total + tied.energy
