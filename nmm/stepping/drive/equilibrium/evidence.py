"""Evidence that the structure, and not the solver, is why no equilibrium was found."""

from collections.abc import Sequence

import numpy as np

from nmm.assembly.state import State
from nmm.stepping.bounds.static_theorem import carried
from nmm.stepping.drive.equilibrium.settling import SettledStep, too_far
from nmm.stepping.drive.equilibrium.vanishing_stiffness import vanishing_stiffness
from nmm.stepping.step.anchors import block_name, largest_mover
from nmm.stepping.step.stepper import Stepper


def evidence(
    stepper: Stepper, state: State, factor: float, found: SettledStep, names: Sequence[str]
) -> str | None:
    """Return the evidence that the structure, not the solver, has failed; None without any.

    The static theorem, a motion without end, a system that is singular with the bonds and contacts
    that are left, or a stiffness that the load takes away.
    """
    attempt = found.attempt
    proof = carried(stepper, state, factor)
    said = [proof.sentence] if proof is not None and proof.fails else []
    far = too_far(stepper, found.carried)
    # Where bodies bend by any angle a tangent may lead far away from an equilibrium that is near.
    moves = attempt.motion > far and not stepper.kinematics.finite
    if (found.mechanism or moves) and np.isfinite(attempt.increment).all():
        body, how = largest_mover(stepper.model, state, attempt.increment)
        name = block_name(stepper.model, body, names)
        if moves:
            share = 100 * far / stepper.size
            way = f"points move by more than {share:.0f} % of the domain in one increment"
        else:
            way = attempt.sentence
        said.append(f"a mechanism was found: {way}, block {name} most: {how}")
    elif attempt.singular:
        said.append(f"a mechanism was found: {attempt.sentence}")
    elif (limit := vanishing_stiffness(stepper, state, factor)) is not None:
        said.append(limit)
    return "; ".join(said) or None
