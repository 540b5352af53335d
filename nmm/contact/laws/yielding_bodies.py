"""Contact dampers without effect, because bodies are softer than the contact springs."""

from nmm.assembly.model import Model
from nmm.contact.laws.contact_laws import ContactLaws

YIELDING = 0.02
"""Springs of a corner over E t up to which they give way, and not the block: the restitution of
square blocks of one strain is 0.005 off there, of 4 to 1 0.02, and 0.05 and 0.17 at 0.1."""


def yielding_bodies(laws: ContactLaws, model: Model) -> str:
    """Warn that bodies deform in place of damped contacts; empty where they do not.

    A spring that is stiffer than what it pushes hardly moves, and its damper takes nothing: the
    energy of an impact becomes vibration of the bodies.
    """
    manifold = model.manifold
    stiff = laws.normal_penalty / (float(model.modulus.max()) * model.thickness)
    if not laws.damps or stiff <= YIELDING or manifold.n_unknowns == 3 * manifold.n_bodies:
        return ""
    return (
        f"contacts with damping or restitution have springs of {stiff:.3g} E, stiffer than bodies "
        "that have strain: these give way in place of the damper, and square blocks part at 0.75 "
        'of their speed whatever is requested; take [cover] functions = "rigid", or [contact] '
        f"normal_penalty of {YIELDING:g} or less"
    )
