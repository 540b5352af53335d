"""Verdicts on growing loads: that no equilibrium was found, and what shows that there is none."""

from collections.abc import Sequence
from dataclasses import replace

from nmm.assembly.state import State
from nmm.stepping.drive.equilibrium.evidence import evidence
from nmm.stepping.drive.equilibrium.relaxation import RelaxationEnd
from nmm.stepping.drive.equilibrium.settling import SettledStep
from nmm.stepping.drive.under_load import Beyond, LoadSchedule, UnderLoad
from nmm.stepping.drive.verdict import COLLAPSED, CONVERGED, FAILED, FAILURE, RunVerdict
from nmm.stepping.step.anchors import ANCHOR
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.unopposed import unheld


def with_unheld(
    verdict: RunVerdict, stepper: Stepper, state: State, names: Sequence[str]
) -> RunVerdict:
    """Add which blocks nothing but anchors would hold, and whether anchors were used."""
    balanced = verdict.code == CONVERGED
    said = [verdict.sentence, *unheld(stepper, state, names, balanced)]
    if stepper.anchored:
        said.append(f"anchors of {ANCHOR:.0e} of the blocks' stiffness were used and carry nothing")
    return replace(verdict, sentence="; ".join(said))


def no_rest(rest: RelaxationEnd) -> RunVerdict:
    """Return the verdict on loose blocks that relaxation did not bring to rest."""
    sentence = f"after {rest.steps} steps of relaxation: {rest.sentence}"
    if rest.falls:
        return RunVerdict(COLLAPSED, f"no equilibrium of loose blocks {sentence}", 0.0)
    return RunVerdict(FAILED, f"no equilibrium of loose blocks was found {sentence}", 0.0)


def no_equilibrium(
    at: UnderLoad,
    factor: float,
    found: SettledStep,
    schedule: LoadSchedule,
    stepper: Stepper,
    names: Sequence[str],
    beyond: Beyond,
) -> RunVerdict:
    """Return the verdict on a load that was not solved: of the structure, if that is shown."""
    reached, reason = at.state.load_factor, found.attempt.sentence

    def proven() -> str | None:
        return evidence(stepper, at.state, factor, found, names)

    def passed() -> str | None:
        limit = beyond(at.state, factor) if schedule.until_failure and reached else None
        return None if limit is None else limit.sentence

    # The static theorem knows bonds as they were: of those that break the path tells sooner.
    solved = found.attempt.solved
    shown = passed() or proven() if solved and solved.broken else proven() or passed()
    where = f"at load factor {reached:.6g} after {at.changed}"
    if not at.changed:
        where = f"between load factors {reached:.6g} and {factor:.6g}"
    above = at.increment if at.changed else factor - reached
    tolerance = above / reached if reached else None
    if shown is None:
        sentence = (
            f"no equilibrium was found {where}: {reason}; "
            "nothing shows that the structure is at fault: it may carry more; try another "
            "enforcement or a larger loading.tolerance"
        )
        return RunVerdict(FAILED, sentence, reached, tolerance)
    if not schedule.until_failure or tolerance is None:
        return RunVerdict(COLLAPSED, f"no equilibrium {where}: {shown}", reached)
    none = f"none after {at.changed}" if at.changed else f"none at {factor:.6g}"
    sentence = (
        f"in equilibrium up to load factor {reached:.6g}, {none} "
        f"({100 * tolerance:.2g} % above): {shown}"
    )
    return RunVerdict(FAILURE, sentence, reached, tolerance)
