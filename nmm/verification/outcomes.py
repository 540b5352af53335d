"""Run benchmarks and say how each quantity came out."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from time import process_time

from nmm.errors import Fault, FormulationError, NmmError
from nmm.verification.base import Case, Checks
from nmm.verification.registry import CASES


@dataclass(frozen=True)
class Outcome:
    """One variant of a benchmark under one formulation.

    Attributes
    ----------
    case
        The variant.
    formulation
        Name of the formulation.
    checks
        Quantities by name; empty when the run could not be made.
    fault
        Why the run could not be made, else empty.
    seconds
        Processor time.
    """

    case: Case
    formulation: str
    checks: Checks
    fault: str
    seconds: float

    @property
    def passed(self) -> bool:
        """Whether the run was made and every quantity is within its tolerance."""
        return not self.fault and all(check.passed for check in self.checks.values())

    @property
    def label(self) -> str:
        """Benchmark, variant and formulation."""
        return ", ".join(filter(None, (self.case.name, self.case.variant, self.formulation)))

    def lines(self) -> Iterator[str]:
        """Yield one line for each quantity, or the fault."""
        if self.fault:
            yield f"{self.label}: {self.fault}"
        for name, check in self.checks.items():
            verdict = "passed" if check.passed else f"FAILED ({check.reason})"
            yield (
                f"{self.label}: {name}: {check.shown}, reference {check.wanted}, "
                f"error {check.error:.1e}, allowed {check.tolerance:.1e}: {verdict}"
            )


def named(text: str) -> list[str]:
    """Names of `CASES` that a name stands for.

    A name stands for all that begin with it and go on with another word or letter: "B" for all of
    that group, "B8" for "B8" and "B8 oblique", "B1" for "B1 friction" and "B1 cohesion" and not
    "B10". A ``module:Class`` is left as it is.

    Raises
    ------
    FormulationError
        When no name begins with it.
    """
    wanted = text.lower()
    found = [
        name
        for name in CASES.table
        if name.lower().startswith(wanted)
        and not (wanted[-1:].isdigit() and name[len(wanted) : len(wanted) + 1].isdigit())
    ]
    if text and found:
        return found
    if ":" in text:
        return [text]
    near = [name for name in CASES.table if text and wanted in name.lower()]
    near = near or get_close_matches(text, CASES.table, n=1)
    expected = "a benchmark of `nmm verify --list`, a published case folder, or module:Class"
    remedy = f'did you mean "{near[0]}"?' if near else "correct the name"
    raise FormulationError(Fault("benchmark", f'"{text}"', expected, remedy))


def runs(names: Iterable[str] | None = None, slow: bool = False) -> Iterator[tuple[Case, str]]:
    """Yield every variant of the named benchmarks (all when None) with each formulation, once.

    Variants of more than a few seconds are left out unless ``slow``, or unless their benchmark is
    named in full.
    """
    texts = None if names is None else list(names)
    chosen = CASES.table if texts is None else [name for text in texts for name in named(text)]
    for name in dict.fromkeys(chosen):
        in_full = texts is not None and name in texts
        for case in CASES.load_said(name).variants():
            if case.slow and not in_full and not slow:
                continue
            for formulation in case.formulations:
                yield case, formulation


def judge(case: Case, formulation: str) -> Outcome:
    """Run one variant under one formulation."""
    started = process_time()
    try:
        checks, fault = case.checks(formulation), ""
    except NmmError as error:
        checks, fault = {}, str(error)
    return Outcome(case, formulation, checks, fault, process_time() - started)


def verify(names: Iterable[str] | None = None, slow: bool = False) -> list[Outcome]:
    """Run benchmarks.

    Parameters
    ----------
    names
        Names of `CASES`, or what they begin with; all when None.
    slow
        Whether those of more than a few seconds are run though they are not named in full.
    """
    return [judge(case, formulation) for case, formulation in runs(names, slow)]
