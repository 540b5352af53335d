"""How a path ends: where it was to, past a limit point, or where no balance is found."""

from nmm.stepping.control.position import OnPath, PathEnd
from nmm.stepping.drive.verdict import CONVERGED, FAILED, FAILURE, RunVerdict
from nmm.stepping.step.trial import Attempt

# Share of the largest load factor below which a load factor is none.
NOTHING = 1e-9
# Share of the largest by which a load factor must be below it for a limit point to have been
# passed: what balance leaves of a load on a plateau is less (audit `residual`).
BELOW_PEAK = 1e-6
# Relative rounding of the sums by which a path comes to its end.
ROUNDED_END = 1e-12


def arrived(at: OnPath, length: float, end: PathEnd) -> RunVerdict | None:
    """Return the verdict where the path is at its end; None before.

    ``length`` is the total change of what is controlled at which to stop.
    """
    factor, peak = at.state.load_factor, at.peak
    fallen = peak > 0 and factor <= max(end.fall, NOTHING) * peak
    through = at.gone >= length * (1 - ROUNDED_END)
    if not fallen and not through and factor < end.factor * (1 - ROUNDED_END):
        return None
    if fell(at):
        sentence = (
            f"a limit point was passed: the largest load factor on the path is {peak:.6g}, and "
            f"the path goes on in equilibrium down to {factor:.6g}"
        )
        return RunVerdict(FAILURE, sentence, peak, 0.0)
    return RunVerdict(CONVERGED, f"equilibrium along the path to load factor {factor:.6g}")


def no_balance(at: OnPath, attempt: Attempt) -> RunVerdict:
    """Return the verdict where no balance was found further on."""
    peak, factor = at.peak, at.state.load_factor
    if attempt.singular:
        when = " after the last bonds broke" if at.events else ""
        return _failure(at, f"nothing holds it{when}", attempt.sentence)
    if fell(at):
        return _failure(at, "a limit point was passed", attempt.sentence)
    sentence = (
        f"no balance was found beyond load factor {factor:.6g} on the path: "
        f"{attempt.sentence}; try shorter steps, or another control"
    )
    return RunVerdict(FAILED, sentence, peak)


def no_event(at: OnPath) -> RunVerdict:
    """Return the verdict where no load brings another bond to its limit."""
    why = "no load brings another bond to its limit"
    if fell(at):
        return _failure(at, "a limit point was passed", why)
    reached = at.state.load_factor
    sentence = f"equilibrium up to load factor {reached:.6g}, {at.events} events on: {why}"
    return RunVerdict(CONVERGED, sentence)


def fell(at: OnPath) -> bool:
    """Whether the load has fallen from its largest; one that only pulls back has none."""
    return at.peak > 0 and at.state.load_factor < at.peak * (1 - BELOW_PEAK)


def _failure(at: OnPath, shown: str, why: str) -> RunVerdict:
    sentence = (
        f"{shown}: the largest load factor on the path is {at.peak:.6g}; the path was "
        f"followed to {at.state.load_factor:.6g}: {why}"
    )
    return RunVerdict(FAILURE, sentence, at.peak, 0.0)
