"""How contacts stand after a step: how many in which state, how deep, how stiff."""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats, Ints
from integration.contraction import largest, least, summed
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.frozen import with_parts
from nmm.stepping.reports.rebounds import Rebound, rebound
from nmm.stepping.reports.totals import Totals
from nmm.stepping.step.anchors import block_name
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints


def tallied(
    totals: Totals, stepper: Stepper, contacts: "ContactPoints", before: State, attempt: Attempt
) -> tuple[Totals, float]:
    """Return the totals with the contacts of a step; the overlap (m) that their forces go with."""
    from nmm.contact.detection.tolerances import MIDPOINT_GAPS
    from nmm.contact.problem.contact_state import NAMES

    contact, after = stepper.plan.contact, attempt.state
    assert contact is not None
    gap = contacts.distance
    # Of joints that came apart only lines are left, of which bodies that turn lie on either side.
    gap[len(gap) - len(contact.record.book.lost) :] = np.inf
    overlap = ends = -float(least(gap, initial=0.0))
    turned = 0.0
    if gap.size:
        turned = float(largest(np.abs(after.frames.angle - before.frames.angle), initial=0.0))
    if turned * attempt.motion > MIDPOINT_GAPS * overlap:  # gaps are solved along straight ways
        acts = (contacts.normal_force < 0) & ~contacts.is_joint
        surface = contact.partners.surface(after)
        gap[acts] = contact.geometry.gaps(contacts.take(acts), before, after, surface)
        ends = -float(least(gap, initial=0.0))
    share, deepest = totals.overlap, totals.deepest
    if ends > share * np.sqrt(least(stepper.model.manifold.body_area)):
        over = _over_smaller(stepper, contacts, gap)
        at = int(over.argmax())
        if over[at] > share:
            share, deepest = float(over[at]), _deepest(stepper, contacts, at, gap[at], after.time)
    tally = np.bincount(contacts.state, minlength=len(NAMES)).tolist()
    counts = dict(zip(NAMES, tally, strict=True)) | {"broken": contact.broken_bonds}
    if contact.exact and attempt.booked is not None and attempt.solved is not None:
        force = partial(stepper.plan.force, before, Instant.of(before))
        found = rebound(stepper.model, contact, attempt.solved, before, after, force)
        if found is not None and found.energy > totals.rebound:
            told = _thrown_apart(stepper, found, after.time)
            totals = with_parts(totals, rebound=found.energy, thrown=told)
    ways = 0 if attempt.solved is None or attempt.solved.ways is None else attempt.solved.ways()
    totals = with_parts(
        totals,
        ways=max(totals.ways, ways),
        alike=after.load_factor if ways > 1 and totals.alike is None else totals.alike,
        stiffest=max(totals.stiffest, contact.solver.stiffest or 0.0),
        borne=max(totals.borne, _borne(contacts)),
        penetration=max(totals.penetration, overlap),
        overlap=share,
        deepest=deepest,
        largest=totals.largest if counts == totals.counts else _largest(totals, counts),
        counts=counts,
    )
    return totals, overlap


def _largest(totals: Totals, counts: dict[str, int]) -> dict[str, int]:
    """Return the largest number of contacts in each state so far."""
    return {name: max(totals.largest.get(name, 0), n) for name, n in counts.items()}


def _borne(contacts: "ContactPoints") -> float:
    """Return the sum of the sizes of all forces (N)."""
    return float(summed(np.abs(contacts.normal_force)) + summed(np.abs(contacts.shear_force)))


def _over_smaller(stepper: Stepper, contacts: "ContactPoints", gap: Floats) -> Floats:
    """Return overlaps (m,) over the size of the smaller of both bodies, the root of its area."""
    manifold = stepper.model.manifold
    owner = manifold.boundary.body
    size = np.sqrt(manifold.body_area)
    return np.asarray(-gap / np.minimum(size[owner[contacts.edge_a]], size[owner[contacts.edge_b]]))


def _deepest(stepper: Stepper, contacts: "ContactPoints", at: int, gap: float, time: float) -> str:
    """Say how deep a contact point lies, between which blocks, and when it was so."""
    owner = stepper.model.manifold.boundary.body
    pair = _named(stepper, owner[[contacts.edge_a[at], contacts.edge_b[at]]])
    when = f" at {time:.4g} s" if "inertia" in stepper.plan.effects else ""
    return f"{-gap:.3g} m between {pair}{when}"


def _thrown_apart(stepper: Stepper, found: Rebound, time: float) -> str:
    """Say how fast bodies met and part, which, and when."""
    pair = _named(stepper, found.bodies)
    return f"{pair} met at {found.met:.3g} m/s and parted at {found.parts:.3g} at {time:.4g} s"


def _named(stepper: Stepper, bodies: Ints) -> str:
    """Return the names of the blocks of two bodies."""
    made = stepper.discretisation
    one, other = (block_name(made.model, body, made.setup.region_name) for body in bodies)
    return f"{one} and {other}"
