"""Run benchmarks and say how each quantity came out."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from time import perf_counter

from nmm.errors import NmmError
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
        Wall-clock time.
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
            relation = {"equal": "=", "at_most": "<=", "at_least": ">="}[check.bound]
            verdict = "passed" if check.passed else f"FAILED ({check.reason})"
            yield (
                f"{self.label}: {name}: {check.computed:.9g} {relation} {check.reference:.9g}, "
                f"error {check.error:.1e}, allowed {check.tolerance:.1e}: {verdict}"
            )


def runs(names: Iterable[str] | None = None, slow: bool = False) -> Iterator[tuple[Case, str]]:
    """Yield every variant of the named benchmarks (all when None) with each formulation.

    Of "all" those of more than a few seconds are left out unless ``slow``.
    """
    for name in CASES.table if names is None else names:
        for case in CASES.load(name).variants():
            if case.slow and not slow and names is None:
                continue
            for formulation in case.formulations:
                yield case, formulation


def judge(case: Case, formulation: str) -> Outcome:
    """Run one variant under one formulation."""
    started = perf_counter()
    try:
        checks, fault = case.checks(formulation), ""
    except NmmError as error:
        checks, fault = {}, str(error)
    return Outcome(case, formulation, checks, fault, perf_counter() - started)


def verify(names: Iterable[str] | None = None, slow: bool = False) -> list[Outcome]:
    """Run benchmarks.

    Parameters
    ----------
    names
        Names of `CASES`; all that are not slow when None.
    slow
        Whether "all" includes those of more than a few seconds.
    """
    return [judge(case, formulation) for case, formulation in runs(names, slow)]
