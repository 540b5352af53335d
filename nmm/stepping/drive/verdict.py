"""How a run ended, as a code and a sentence."""

from dataclasses import dataclass

CONVERGED = "converged"
UNBALANCED = "unbalanced"
FAILURE = "failure_load"
COLLAPSED = "collapsed"
FAILED = "failed"
SPENT = "budget_spent"

EXIT_CODES = {CONVERGED: 0, FAILURE: 0, FAILED: 2, SPENT: 3, COLLAPSED: 4, UNBALANCED: 5}
"""What the command line leaves with; 1 are faults of the files."""

MEANT = {
    CONVERGED: "all steps were solved, and no audit of energy, momentum or balance failed",
    UNBALANCED: "all steps were solved, but an audit of energy, momentum or balance failed: the "
    "answer is not to be relied on; the warnings say what is off, where, and what to do",
    FAILURE: "a run until failure found the load that the structure carries, and shows that it "
    "carries no more",
    COLLAPSED: "the structure has no equilibrium under a load that it was to carry; shown by a "
    "mechanism, a motion that does not end, a stiffness that vanishes, or the static theorem",
    FAILED: "a step could not be solved, and nothing shows that the structure is at fault",
    SPENT: "the budget of seconds or steps was spent before the end",
}
"""Every code in words."""


def status_code(status: str) -> int:
    """Return the exit code of a run's status; that of a failed one for runs without an end."""
    return EXIT_CODES.get(status, EXIT_CODES[FAILED])


@dataclass(frozen=True)
class RunVerdict:
    """The end of a run.

    Attributes
    ----------
    code
        A key of `MEANT`.
    sentence
        The same in words, with place, number and remedy.
    load_factor, tolerance
        Largest factor in equilibrium and the relative width of the bracket; None elsewhere.
    """

    code: str
    sentence: str
    load_factor: float | None = None
    tolerance: float | None = None


@dataclass(frozen=True)
class LimitPoint:
    """A load factor that a path passes and falls from.

    Attributes
    ----------
    factor
        The largest on the path.
    sentence
        What was seen.
    """

    factor: float
    sentence: str
