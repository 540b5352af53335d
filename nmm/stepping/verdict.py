"""How a run ended, as a code and a sentence."""

from dataclasses import dataclass

CONVERGED = "converged"
FAILURE = "failure_load"
FAILED = "failed"


@dataclass(frozen=True)
class RunVerdict:
    """The end of a run.

    Attributes
    ----------
    code
        "converged"; "failure_load" when a run until failure found it; "failed" when a step could
        not be solved however short.
    sentence
        The same in words, with place, number and remedy.
    load_factor, tolerance
        Largest factor in equilibrium and the relative width of the bracket; None elsewhere.
    """

    code: str
    sentence: str
    load_factor: float | None = None
    tolerance: float | None = None
