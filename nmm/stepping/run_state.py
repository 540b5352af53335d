"""All of a run that matters: what a checkpoint stores and a run goes on from."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from nmm.results.storage.values import Arrays, Kinds, decoded, encoded
from nmm.stepping.drive.stages import StagesSoFar
from nmm.stepping.reports.totals import Totals
from nmm.stepping.reports.zero import ZeroDisplacement
from nmm.stepping.step.carried import CarriedState

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.assembly.state import State
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.stepping.drive.phases import RunPosition


@dataclass(frozen=True)
class RunState:
    """Where a run stands. What is not in it may be dropped without changing an answer.

    Attributes
    ----------
    at
        The last accepted state with its contacts, and what decides the next step.
    carried
        What the stepper and the effects carry besides.
    totals
        Of what was recorded.
    stages
        Those that were entered; None of a run without stages.
    zero
        What displacements count from.
    before
        Where the last step began, in scenes with matter that flows: an audit asks for it.
    """

    at: "RunPosition"
    carried: CarriedState
    totals: Totals
    stages: StagesSoFar | None = None
    zero: ZeroDisplacement = field(default_factory=ZeroDisplacement)
    before: "State | None" = None

    def to_arrays(self) -> Arrays:
        """Return it as arrays by name."""
        return encoded(self, KINDS)

    def checked(self, model: "Model") -> "RunState":
        """Return it, if it fits a model.

        Raises
        ------
        ValueError
            When its arrays have other sizes, or contacts of edges that the model does not have.
        """
        state, manifold = self.at.state, model.manifold
        unknowns, bodies = (manifold.n_unknowns,), manifold.n_bodies
        vectors = state.deformation, state.velocity, state.acceleration
        places = state.frames.centre.shape == (bodies, 2) and state.frames.angle.shape == (bodies,)
        if any(one.shape != unknowns for one in vectors) or not places:
            raise ValueError(f"it is not of {manifold.n_unknowns} unknowns and {bodies} bodies")
        edges = len(manifold.boundary.body)
        for points in _contact_points(self):
            columns = {**vars(points), **points.history}
            columns.pop("history")
            sizes = {len(column) for column in columns.values()}
            sides = points.edge_a, points.edge_b
            if len(sizes) > 1 or any(len(s) and not 0 <= s.min() <= s.max() < edges for s in sides):
                raise ValueError("its contacts are not of this model")
        return self

    @classmethod
    def from_arrays(cls, arrays: Arrays) -> "RunState":
        """Return what `to_arrays` made these of.

        Raises
        ------
        ValueError
            When they were not made by it.
        """
        found = decoded(arrays, KINDS)
        if not isinstance(found, cls):
            raise ValueError(f"it holds a {type(found).__name__}")
        return found


def _contact_points(run: RunState) -> Iterator["ContactPoints"]:
    """Yield all contact points that a state holds."""
    carried = run.carried.effects.get("contact")
    found = [run.at.contacts]
    if carried is not None:
        book = carried.record.book
        found += [book.points, book.lost, carried.record.known]
    yield from (points for points in found if points is not None)


_PLACES = {
    "integration.polygons": ("Polygons",),
    "nmm.assembly.state": ("State", "Frames"),
    "nmm.contact.detection.contacts": ("Contacts", "FaceContacts"),
    "nmm.effects.motion.reactions": ("Reactions",),
    "nmm.contact.solution.record": ("ContactRecord", "ContactCarried"),
    "nmm.contact.points.contact_points": ("ContactPoints",),
    "nmm.contact.points.joint_book": ("JointBook",),
    "nmm.geometry.blocks": ("Regions",),
    "nmm.geometry.geometry": ("Geometry",),
    "nmm.stepping.adaptive.control": ("StepChoice",),
    "nmm.stepping.control.position": ("OnPath",),
    "nmm.stepping.drive.in_time": ("InTime",),
    "nmm.stepping.drive.stages": ("StagesSoFar",),
    "nmm.stepping.drive.under_load": ("UnderLoad", "Rest"),
    "nmm.stepping.reports.accounts": ("EnergySources", "EnergyRise"),
    "nmm.stepping.reports.ledger": ("Ledger",),
    "nmm.stepping.reports.lengths": ("StepLengths",),
    "nmm.stepping.reports.output": ("EventWatch",),
    "nmm.stepping.reports.totals": ("Totals",),
    "nmm.stepping.reports.zero": ("ZeroDisplacement",),
    "nmm.stepping.run_state": ("RunState",),
    "nmm.stepping.step.carried": ("CarriedState", "LaidAnew"),
}
KINDS: Kinds = {name: f"{module}:{name}" for module, names in _PLACES.items() for name in names}
"""Dataclasses that a state may hold; no other is made of what a file says."""
