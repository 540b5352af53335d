"""The summary of a run: one record of numbers, as JSON in the run folder and as a table."""

import json
import math
import types
from collections import abc
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from types import NoneType
from typing import Any, get_args, get_origin

from nmm.errors import NmmError
from nmm.results.versions import installed_versions

RUNNING = "running"
STOPPED = "stopped"
REPLACING = "replacing"
UNKNOWN = "unknown"


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
        Load factor that admissible forces of contacts, bonds and members cannot pass where the run
        begins, by the static theorem.
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
        except (ValueError, RecursionError) as fault:  # more than Python reads
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
