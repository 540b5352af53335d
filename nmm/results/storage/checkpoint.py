"""The checkpoint of a run folder: what a run goes on from, and what the folder contained then."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from nmm.errors import DamageError, StorageError
from nmm.results.storage import files
from nmm.results.storage.values import Arrays
from nmm.results.storage.writing import write_arrays

CHECKPOINT_FORMAT = 3
"""Version of what a checkpoint holds: it grows with every change of what a run carries."""

HEADER = "header"
AGAIN = "run the scene again"


@dataclass(frozen=True)
class CheckpointHeader:
    """What a checkpoint belongs to, and how much of its folder was written before it.

    Attributes
    ----------
    format
        Version of what it holds.
    version
        Of the program.
    scene_hash, formulation_hash
        Of what was run.
    topologies, frames, rows
        Counts of files and of lines of the history.
    columns
        Names in the head of the history.
    """

    format: int
    version: str
    scene_hash: str
    formulation_hash: str
    topologies: int = 0
    frames: int = 0
    rows: int = 0
    columns: tuple[str, ...] = ()


@dataclass(frozen=True)
class Checkpoint:
    """A checkpoint as its file holds it: the header, and the values of the run as arrays."""

    header: CheckpointHeader
    arrays: Arrays


def write_checkpoint(path: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint whole or not at all, and bring it to the disk.

    Raises
    ------
    StorageError
        When the system refuses; the checkpoint before is left.
    """
    header = np.array(json.dumps(asdict(checkpoint.header)))
    write_arrays(path, {HEADER: header, **checkpoint.arrays}, to_disk=True)


def read_checkpoint(folder: Path, expected: CheckpointHeader) -> Checkpoint:
    """Read the checkpoint of a folder, which is to be of the program and texts ``expected``.

    Raises
    ------
    StorageError
        When there is none, or it is of another version, scene or formulation.
    DamageError
        When it was cut off or altered.
    """
    path = folder / files.CHECKPOINT
    if not path.exists():
        raise StorageError(
            f"{folder}: no {files.CHECKPOINT} in it: expected a run whose scene has "
            f"[output] checkpoint, as {{ every_steps = 50 }}: add it and {AGAIN}"
        )
    arrays = files.read_arrays(path)
    header = _header(path, arrays)
    for name, what in (
        ("format", "of another version"),
        ("version", "of another version"),
        ("scene_hash", "of another scene"),
        ("formulation_hash", "of another formulation"),
    ):
        found, wanted = getattr(header, name), getattr(expected, name)
        if found != wanted:
            raise StorageError(
                f"{path}: {what}: {name} {found!r}: expected {wanted!r}: {AGAIN}, or go on with "
                "what wrote it"
            )
    return Checkpoint(header, {name: a for name, a in arrays.items() if name != HEADER})


def _header(path: Path, arrays: Mapping[str, npt.NDArray[Any]]) -> CheckpointHeader:
    try:
        found = json.loads(arrays[HEADER].item())
        made = CheckpointHeader(**{**found, "columns": tuple(found["columns"])})
        if min(made.topologies, made.frames, made.rows) < 0:
            raise ValueError("a count is negative")
    except (KeyError, TypeError, ValueError) as fault:
        raise damaged(path, str(fault)) from fault
    return made


def damaged(path: Path, why: str) -> DamageError:
    """Return the fault of a checkpoint that cannot be gone on from."""
    return DamageError(
        f"{path}: damaged ({why}): expected the file as the run wrote it: restore it or {AGAIN}"
    )
