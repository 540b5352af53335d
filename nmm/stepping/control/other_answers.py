"""Other answers of a control's equation than the next step of the path: they are none."""

from dataclasses import replace

from nmm.stepping.control.locating import TriedStep
from nmm.stepping.control.position import OnPath

# A step from this share of the largest load to below none, by more than that share, is a jump.
JUMPS_FROM, LEAST = 0.5, 1e-6
# Share of the energy of a step that it must take, by what is stored, where the load falls.
TAKEN = 0.01


def ahead(at: OnPath, found: TriedStep) -> TriedStep:
    """Return a trial, not converged where it jumps over the unloaded state to loads the other way.

    A control that is not the motion itself may have a second answer there, however short the step.
    """
    before, after = at.state.load_factor, found.attempt.state.load_factor
    if not before > JUMPS_FROM * at.peak or not after < -LEAST * at.peak:
        return found
    return _refused(
        found, f"the load would turn round in one step, from {before:.6g} to {after:.6g}"
    )


def taking(at: OnPath, found: TriedStep) -> TriedStep:
    """Return a step of so much energy, not converged where the load falls and hardly any is taken.

    Back along the way of loading the equation of a dissipation has a second answer, which only what
    it leaves out tells from no step at all, as turned bodies.
    """
    taken = 0.0 if found.attempt.solved is None else found.attempt.solved.loss
    falls = found.attempt.state.load_factor < at.state.load_factor
    if not falls or taken >= TAKEN * found.way:
        return found
    return _refused(found, f"a step of {found.way:.4g} J unloads, and takes {taken:.4g} J")


def _refused(found: TriedStep, sentence: str) -> TriedStep:
    if not found.attempt.converged:
        return found
    return replace(found, attempt=replace(found.attempt, converged=False, sentence=sentence))
