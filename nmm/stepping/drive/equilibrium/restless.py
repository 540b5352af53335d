"""Which block moves most where none is found to rest, how, and whether others touch it."""

from collections.abc import Sequence

from nmm.assembly.model import Model
from nmm.stepping.step.anchors import block_name, largest_mover
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt


def who(moving: Stepper, attempt: Attempt | None, names: Sequence[str], first: str = "") -> str:
    """Return the name of the block that moves most, and how; one that nothing touches moves freely.

    ``first`` is what to do before supports are added to one that is touched.
    """
    if attempt is None:
        return "no step converged"
    if not attempt.increment.any():
        return "nothing moves, yet the contact forces of what stands still were not found"
    model = moving.model
    body, how = largest_mover(model, attempt.state, attempt.increment)
    name = block_name(model, body, names)
    if touched(model, attempt, body):
        return (
            f"block {name} moves most: {how}; the blocks that touch it do not hold it: {first}"
            "add supports, friction or strength, or [inertia] to follow its motion"
        )
    return f"block {name} can move freely: {how}; add a support or friction, or [inertia]"


def touched(model: Model, attempt: Attempt, body: int) -> bool:
    """Return whether anything pressed on a body in a step."""
    if attempt.solved is None:
        return False
    contacts, answer = attempt.solved.contacts, attempt.solved.answer
    owner = model.manifold.boundary.body
    beside = (owner[contacts.edge_a] == body) | (owner[contacts.edge_b] == body)
    return bool((beside & (answer.normal_force < 0)).any())
