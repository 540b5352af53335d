"""The parts that contact is made of."""

from collections.abc import Callable
from dataclasses import dataclass

from integration.arrays import Bools
from nmm.contact.candidates.partners import Partners
from nmm.contact.enforcement.base import Enforcement
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.mortar.trace_space import TraceSpace
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.cracks.bonded_cracks import BondedCracks


@dataclass(frozen=True)
class ContactParts:
    """Parts of contact.

    Attributes
    ----------
    laws, partners, enforcement
        Which laws act, which points may meet, and how the laws are made to hold.
    joint_rule
        "corners" or "gauss", where joints act along their edge, and at how many Gauss points.
    cracks
        Cracks within bodies whose faces hold together.
    mixed
        Whether bonds on them that soften have their laws in the mixed form: not where they move,
        nor where nothing is a spring.
    held
        (B,) bodies that a support holds as a whole, in both directions.
    bends
        Whether faces bend between their ends: contacts then act at points of the material.
    trace_space
        Where exact conditions on faces are held in the mean, None where none are.
    keeps_energy
        Whether springs are to give back what they store.
    acted_on
        From joint points (m,) to whether something acts on the face there, for each side; None
        where nothing can.
    """

    laws: ContactLaws
    partners: Partners
    enforcement: Enforcement
    joint_rule: tuple[str, int]
    cracks: BondedCracks
    mixed: bool
    held: Bools
    bends: bool
    trace_space: TraceSpace | None
    keeps_energy: bool = False
    acted_on: Callable[[ContactPoints], tuple[Bools, Bools] | None] | None = None
