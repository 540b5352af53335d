"""The summary of a run: one record of numbers, as JSON in the run folder and as a table."""

import json
import math
import platform
import types
from collections import abc
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field, fields, replace
from functools import cache
from importlib import metadata
from types import NoneType
from typing import TYPE_CHECKING, Any, get_args, get_origin

from nmm.errors import NmmError

if TYPE_CHECKING:
    from rich.table import Table

RUNNING = "running"
STOPPED = "stopped"
REPLACING = "replacing"
UNKNOWN = "unknown"
# Ends at which the factor that was reached is no failure load.
ON_THE_WAY = ("failed", "collapsed", "budget_spent")
PACKAGES = ("nmm-framework", "numpy", "scipy", "scikit-fem", "shapely", "numba")
# Those that change an answer by rounding where they are installed.
OPTIONAL = ("pymetis", "qdldl", "python-mumps")


def installed_versions() -> dict[str, str]:
    """Return the versions of Python and of the libraries that a result can depend on."""
    return dict(_installed_versions())


@cache
def _installed_versions() -> dict[str, str]:
    """Return them as read from the files of all packages, once."""
    found = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "not installed"
    for name in OPTIONAL:
        with suppress(metadata.PackageNotFoundError):
            found[name] = metadata.version(name)
    return found


@dataclass(frozen=True)
class Summary:
    """What is known of a run as a whole; None stands for a number that was not measured.

    Attributes
    ----------
    status, sentence
        Code of the verdict, "running" or a key of `nmm.stepping.drive.verdict.MEANT`, and the
        sentence that explains it.
    blocks, elements, covers, unknowns, steps, passes, frames
        Counts; covers are physical covers, passes are contact passes summed over steps, frames are
        those stored, of the motion after failure too.
    linear_solver
        What factorises the matrices, and what orders large ones.
    cures
        What was done about dependent functions and small cuts, and on how many of them.
    audits
        What the audits of the run have measured, by name: see `nmm.stepping.audits.table`.
    warnings
        What the audits found, and what is known to spoil the answer of this scene under this
        formulation, in sentences.
    seconds, effect_seconds
        Wall-clock seconds by phase and by effect.
    peak_memory
        Largest resident memory of the process, bytes.
    equilibrium_residual
        Largest relative out-of-balance force of an accepted step.
    largest_penetration
        m, positive when bodies overlapped.
    energy_balance
        (Work done - energy stored - energy lost) / largest of the three.
    change_energy, changes
        Energy (J) that changes of what is solved have added, negative where it went; None without
        any. And what changed, a sentence each.
    fracture_energy, freed_energy
        Energy (J) that cracks took by their toughness where they grew; and what the work was more
        than what is stored and what others took. None without growing cracks.
    condition_estimate
        Estimated 1-norm condition number of the last system matrix.
    smallest_step, largest_step, rejected_steps
        Bounds of the accepted steps (s), and how many were tried and undone, where errors choose
        their lengths; else None.
    failure_load, failure_factor, failure_tolerance
        Largest sum of the scaled loads (N) found in equilibrium, its load factor, and how far
        above it, relative to it, the smallest load was found that is not.
    failure_bound
        Load factor that admissible forces of contacts and bonds cannot pass, by the static theorem.
    factor_of_safety, factor_that_fails
        Largest factor over which strengths were in equilibrium, and the smallest over which they
        were not; None where there was none between the bounds, or none was sought.
    largest_contacts
        Largest number of contact points in each state at one step.
    versions, seed, scene_hash, formulation_hash
        What the run can be repeated from.
    """

    status: str = RUNNING
    sentence: str = "the run has not ended, or was stopped before its end"
    title: str = ""
    blocks: int = 0
    elements: int = 0
    covers: int = 0
    unknowns: int = 0
    linear_solver: str = ""
    cures: Mapping[str, int] = field(default_factory=dict)
    warnings: Sequence[str] = field(default_factory=list)
    audits: Mapping[str, float] = field(default_factory=dict)
    steps: int = 0
    passes: int = 0
    frames: int = 0
    seconds: Mapping[str, float] = field(default_factory=dict)
    effect_seconds: Mapping[str, float] = field(default_factory=dict)
    peak_memory: int | None = None
    equilibrium_residual: float | None = None
    largest_penetration: float | None = None
    energy_balance: float | None = None
    change_energy: float | None = None
    changes: Sequence[str] = field(default_factory=list)
    fracture_energy: float | None = None
    freed_energy: float | None = None
    condition_estimate: float | None = None
    smallest_step: float | None = None
    largest_step: float | None = None
    rejected_steps: int | None = None
    failure_load: float | None = None
    failure_factor: float | None = None
    failure_tolerance: float | None = None
    failure_bound: float | None = None
    factor_of_safety: float | None = None
    factor_that_fails: float | None = None
    largest_contacts: Mapping[str, int] = field(default_factory=dict)
    versions: Mapping[str, str] = field(default_factory=installed_versions)
    seed: int | None = None
    scene_hash: str = ""
    formulation_hash: str = ""

    def to_json(self) -> str:
        """Return the summary as JSON text; numbers that are not finite become null."""
        return json.dumps(_finite(asdict(self)), indent=2, allow_nan=False) + "\n"

    @classmethod
    def from_json(cls, text: str) -> "Summary":
        """Read a summary back.

        Raises
        ------
        NmmError
            When the text is not JSON, names a field that a summary does not have, or gives one a
            value of another kind.
        """
        try:
            values = json.loads(text)
        except json.JSONDecodeError as fault:
            raise NmmError(f"summary.json, line {fault.lineno}: not JSON ({fault.msg})") from fault
        except (
            ValueError,
            RecursionError,
        ) as fault:  # more than Python reads
            raise NmmError(f"summary.json: not JSON ({fault})") from fault
        if not isinstance(values, dict):
            raise NmmError("summary.json: expected a table of fields")
        return cls.from_mapping(values)

    @classmethod
    def from_mapping(cls, values: Mapping[str, Any]) -> "Summary":
        """Make a summary of a mapping of its fields; the others keep their defaults.

        Raises
        ------
        NmmError
            When a key is not a field of a summary, or its value is of another kind.
        """
        known = {item.name for item in fields(cls)}
        strange = sorted(set(values) - known)
        if strange:
            raise NmmError(
                f"summary: unknown field {strange[0]!r}: expected one of {', '.join(sorted(known))}"
            )
        for item in fields(cls):
            if item.name in values and not _fits(values[item.name], item.type):
                raise NmmError(
                    f"summary: {item.name}: {values[item.name]!r}: expected {item.type}: "
                    "restore the file"
                )
        return cls(**values)


@dataclass(frozen=True)
class Safety:
    """The factor of safety of a scene, bracketed.

    Attributes
    ----------
    holds, fails
        Largest factor with equilibrium and smallest without; None where there is none.
    shown
        Whether failing is shown to be the structure's and not the solver's.
    sentence
        What the run that fails says.
    runs
        How many factors were tried.
    """

    holds: float | None
    fails: float | None
    shown: bool
    sentence: str
    runs: int

    def told(self, summary: Summary) -> Summary:
        """Return the summary of the run at the factor that holds with what is known of others."""
        found = replace(summary, factor_of_safety=self.holds, factor_that_fails=self.fails)
        if self.holds is None:
            said = f"no factor of safety down to {self.fails:.6g}: {summary.sentence}"
            return replace(found, sentence=said)
        if self.fails is None:
            said = f"in equilibrium up to strength over {self.holds:.6g}, the highest factor tried"
            return replace(found, sentence=said)
        said = (
            f"factor of safety {self.holds:.6g}: in equilibrium with strength over it, not over "
            f"{self.fails:.6g} ({self.runs} runs): {self.sentence}"
        )
        spoilt = summary.status == "converged" and not self.shown
        return replace(found, status="failed" if spoilt else summary.status, sentence=said)


def _fits(value: Any, kind: Any) -> bool:
    """Whether a value read from JSON is of the kind that a field's annotation names."""
    inner = get_args(kind)
    match get_origin(kind):
        case abc.Mapping:
            return isinstance(value, Mapping) and all(_fits(v, inner[1]) for v in value.values())
        case abc.Sequence:
            return isinstance(value, list | tuple) and all(_fits(v, inner[0]) for v in value)
        case types.UnionType:
            return any(_fits(value, one) for one in inner)
    if kind is float:  # one that is not finite was written as null
        return value is None or (isinstance(value, int | float) and not isinstance(value, bool))
    if kind in (int, str, bool, NoneType):
        return isinstance(value, kind) and (kind is bool or not isinstance(value, bool))
    return True


def _finite(value: Any) -> Any:
    """Replace numbers that JSON cannot hold by None, and numpy scalars by Python's."""
    if isinstance(value, Mapping):
        return {str(key): _finite(item) for key, item in value.items()}
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def failure_line(summary: Summary) -> str | None:
    """Return the failure load with its tolerance in words, None when the run has none.

    A run that failed did not look for one: the factor it reached is no failure load.
    """
    none = summary.failure_factor is None and summary.failure_load is None
    if none or summary.status in ON_THE_WAY:
        return None
    parts = []
    if summary.failure_load is not None:
        parts.append(f"load {_newton(summary.failure_load)}")
    if summary.failure_factor is not None:
        parts.append(f"load factor {summary.failure_factor:.5g}")
    text = "failure " + ", ".join(parts)
    if summary.failure_tolerance is not None:
        text += f"; none {100 * summary.failure_tolerance:.2g} % above it is in equilibrium"
    if summary.failure_bound is not None:
        text += f"; no more than load factor {summary.failure_bound:.5g} by the static theorem"
    return text


def rows(summary: Summary) -> list[tuple[str, str]]:
    """Return label and text of every number that the run has measured."""
    listed: list[tuple[str, str | None]] = [
        ("blocks", f"{summary.blocks:,}"),
        ("elements", f"{summary.elements:,}"),
        ("unknowns", f"{summary.unknowns:,}"),
        ("cures", _counts(summary.cures)),
        ("steps", f"{summary.steps:,}"),
        ("smallest step", _or_none(summary.smallest_step, _second)),
        ("largest step", _or_none(summary.largest_step, _second)),
        ("rejected steps", _or_none(summary.rejected_steps, lambda v: f"{v:,}")),
        ("contact passes", f"{summary.passes:,}"),
        ("failure load", _or_none(summary.failure_load, _newton)),
        (
            "load factor reached" if summary.status in ON_THE_WAY else "failure load factor",
            _or_none(summary.failure_factor, _number),
        ),
        ("factor of safety", _or_none(summary.factor_of_safety, _number)),
        ("factor that fails", _or_none(summary.factor_that_fails, _number)),
        ("failure factor at most", _or_none(summary.failure_bound, _number)),
        ("equilibrium residual", _or_none(summary.equilibrium_residual, _number)),
        ("largest penetration", _or_none(summary.largest_penetration, _metre)),
        ("energy balance", _or_none(summary.energy_balance, _number)),
        ("energy added by changes, J", _or_none(summary.change_energy, _number)),
        ("energy of fracture, J", _or_none(summary.fracture_energy, _number)),
        ("energy freed by fracture, J", _or_none(summary.freed_energy, _number)),
        ("condition estimate", _or_none(summary.condition_estimate, _number)),
        ("contacts at most", _counts(summary.largest_contacts)),
        ("seconds", _seconds(summary.seconds)),
        ("seconds by effect", _seconds(summary.effect_seconds)),
        ("peak memory", _or_none(summary.peak_memory, lambda v: f"{v / 2**20:.0f} MiB")),
        ("seed", _or_none(summary.seed, str)),
        ("scene", summary.scene_hash[:12] or None),
        ("formulation", summary.formulation_hash[:12] or None),
    ]
    return [(label, text) for label, text in listed if text is not None]


def render(summary: Summary) -> "Table":
    """Return the summary as a rich table for the terminal."""
    from rich.table import Table

    table = Table(title=summary.title or None, show_header=False, title_justify="left")
    table.add_column(style="dim", no_wrap=True)
    table.add_column(overflow="fold")
    for label, text in rows(summary):
        table.add_row(label, text)
    return table


def _or_none(value: Any, text: Any) -> str | None:
    return None if value is None else str(text(value))


def _number(value: float) -> str:
    return f"{value:.4g}"


def _second(value: float) -> str:
    return f"{value:.3g} s"


def _metre(value: float) -> str:
    return f"{value:.3g} m"


def _newton(value: float) -> str:
    return f"{value / 1e3:.4g} kN" if abs(value) >= 1e3 else f"{value:.4g} N"


def _counts(counts: Mapping[str, int]) -> str | None:
    return ", ".join(f"{count:,} {name}" for name, count in counts.items() if count) or None


def _seconds(seconds: Mapping[str, float]) -> str | None:
    if not seconds:
        return None
    parts = ", ".join(f"{name} {value:.3g}" for name, value in seconds.items())
    return f"{sum(seconds.values()):.3g} ({parts})"
