"""Files of a run folder: their names, and frames and topologies written and read."""

import re
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from integration.polygons import Polygons
from nmm.errors import DamageError
from nmm.plain_file import plain
from nmm.quantity import Quantity
from nmm.results.frame import Frame, Topology
from nmm.results.storage.archive import from_file
from nmm.results.storage.layout import FIELDS, frame_misfit, topology_misfit
from nmm.results.storage.writing import write_arrays

MARK = "run.json"
LOCK = ".lock"
SCENE = "scene.toml"
FORMULATION = "formulation.toml"
HISTORY = "history.csv"
SUMMARY = "summary.json"
CHECKPOINT = "checkpoint.npz"
FRAMES = "frames"
PICTURES = "pictures"
PARAVIEW = "paraview"

FRAME_NAME = re.compile(r"([0-9]{6,})\.npz")
TOPOLOGY_NAME = re.compile(r"topology(?:_([0-9]+))?\.npz")

_IN_FRAME = [item.name for item in fields(Frame) if item.name != "fields"]
_FRAME_FILES = [f"{name}.npy" for name in _IN_FRAME]
_ARRAYS = ("points", "ring_offsets", "polygon_offsets")
_BESIDE = ("element_region", "region_material", "material_names", "region_names")


def frame_name(index: int) -> str:
    """Return the file name of a frame inside the folder of frames."""
    return f"{index:06d}.npz"


def topology_name(number: int) -> str:
    """Return the file name of a topology: `topology.npz`, then `topology_1.npz`, ..."""
    return f"topology_{number}.npz" if number else "topology.npz"


def numbered(folder: Path, name: re.Pattern[str]) -> dict[int, Path]:
    """Return the files of a folder whose whole name fits a pattern, by the number in it."""
    if not folder.is_dir():
        return {}
    fits = ((name.fullmatch(path.name), path) for path in folder.iterdir())
    return dict(sorted((int(fit[1] or 0), path) for fit, path in fits if fit is not None))


def read_arrays(path: Path) -> dict[str, npt.NDArray[Any]]:
    """Read all arrays of an .npz as `write_arrays` writes it, packed or not: no objects.

    Raises
    ------
    DamageError
        When the file is missing, cut off or altered, or unfolds to more than memory.
    """
    with _read(path):
        return from_file(path)


def archive_fault(path: Path) -> str | None:
    """Return why a frame cannot be whole, from its table of contents alone; None if it may be."""
    try:
        with _read(path), zipfile.ZipFile(plain(path)) as archive:
            _same_names([n for n in archive.namelist() if not _of_fields(n)], _FRAME_FILES)
    except DamageError as fault:
        return str(fault)
    return None


def write_frame(path: Path, frame: Frame) -> None:
    """Write one frame, packed: to two thirds on piles, at 30 MB/s."""
    arrays = {name: getattr(frame, name) for name in _IN_FRAME}
    if frame.fields:
        texts = [
            (name, one.on, one.unit, ",".join(one.components)) for name, one in frame.fields.items()
        ]
        columns = zip(FIELDS, zip(*texts, strict=True), strict=True)
        arrays |= {name: np.array(column, dtype=np.str_) for name, column in columns}
        arrays |= {f"field_{i}": one.values for i, one in enumerate(frame.fields.values())}
    write_arrays(path, arrays, packed=True)


def read_frame(path: Path) -> Frame:
    """Read one frame.

    Raises
    ------
    DamageError
        When the file is missing, cut off or altered.
    """
    stored: dict[str, Any] = read_arrays(path)
    with _read(path):
        _same_names([name for name in stored if not _of_fields(name)], _IN_FRAME)
        if (wrong := frame_misfit(stored)) is not None:
            raise ValueError(wrong)
        named = FRAME_NAME.fullmatch(path.name)
        if named is not None and int(named[1]) != stored["index"]:
            raise ValueError(f"it is frame {stored['index']}")
    known = {name: stored[name] for name in _IN_FRAME}
    plain = {name: a.item() if a.ndim == 0 else a for name, a in known.items()}
    return Frame(**plain, fields=_fields(stored))


def _of_fields(name: str) -> bool:
    return re.fullmatch(r"field_(names|places|units|components|[0-9]+)(\.npy)?", name) is not None


def _fields(stored: dict[str, Any]) -> dict[str, Quantity]:
    """Return the further quantities of a frame; those of earlier versions have none."""
    texts = zip(*(stored.get(name, np.zeros(0)).tolist() for name in FIELDS), strict=True)
    return {
        name: Quantity(on, stored[f"field_{i}"], unit, tuple(filter(None, parts.split(","))))
        for i, (name, on, unit, parts) in enumerate(texts)
    }


def write_topology(path: Path, topology: Topology) -> None:
    """Write one topology."""
    arrays = {name: getattr(topology.elements, name) for name in _ARRAYS}
    arrays |= {"element_region": topology.element_region}
    arrays |= {"region_material": topology.region_material}
    arrays |= {"material_names": np.array(topology.material_names, dtype=np.str_)}
    arrays |= {"region_names": np.array(topology.region_names, dtype=np.str_)}
    write_arrays(path, arrays)


def read_topology(path: Path) -> Topology:
    """Read one topology.

    Raises
    ------
    DamageError
        When the file is missing, cut off or altered.
    """
    stored = read_arrays(path)
    with _read(path):
        _same_names(list(stored), [*_ARRAYS, *_BESIDE])
        if (wrong := topology_misfit(stored)) is not None:
            raise ValueError(wrong)
        return Topology(
            elements=Polygons(*(stored[name] for name in _ARRAYS)),
            element_region=stored["element_region"],
            region_material=stored["region_material"],
            material_names=tuple(str(name) for name in stored["material_names"]),
            region_names=tuple(str(name) for name in stored["region_names"]),
        )


def _same_names(found: list[str], expected: list[str]) -> None:
    if missing := sorted(set(expected) - set(found)):
        raise ValueError(f"it has no array {missing[0].removesuffix('.npy')}")
    if strange := sorted(set(found) - set(expected)):
        raise ValueError(f"it has an array {strange[0].removesuffix('.npy')!r} that none knows")


@contextmanager
def _read(path: Path) -> Iterator[None]:
    """Tell all that a missing or damaged archive raises as one sentence."""
    try:
        yield
    except OSError as fault:
        raise DamageError(unreadable(path, fault)) from fault
    # What zipfile and numpy raise over bytes that were cut off or altered.
    except (
        zipfile.BadZipFile, zlib.error, EOFError, ValueError, KeyError, IndexError, TypeError,
        MemoryError, NotImplementedError, RuntimeError, SyntaxError, OverflowError,
    ) as fault:  # fmt: skip
        if isinstance(fault, DamageError):
            raise
        reason = " ".join(str(fault).split())[:200] or type(fault).__name__
        raise DamageError(
            f"{path}: damaged ({reason}): expected the file as the run wrote it: restore it or run "
            "the scene again; the other files can be read"
        ) from fault


def unreadable(path: Path, fault: OSError) -> str:
    """Return the sentence about a file that the system does not let us read."""
    if isinstance(fault, FileNotFoundError):
        return (
            f"{path}: missing: expected the file that the run wrote: restore it or run the scene "
            "again; the other files can be read"
        )
    reason = (fault.strerror or str(fault)).lower()
    return f"{path}: cannot be read, {reason}: expected a file that can be read: restore it"
