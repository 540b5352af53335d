"""Files of a run folder: their names, and writes that never leave half a file behind."""

import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from integration.polygons import Polygons
from nmm.results.frame import Frame, Topology

SCENE = "scene.toml"
FORMULATION = "formulation.toml"
HISTORY = "history.csv"
SUMMARY = "summary.json"
FRAMES = "frames"
FRAME_PATTERN = "[0-9]*.npz"
TOPOLOGY_PATTERN = "topology*.npz"
PICTURES = "pictures"
PARAVIEW = "paraview"
OF_A_RUN = (
    f"{FRAMES}/{FRAME_PATTERN}",
    TOPOLOGY_PATTERN,
    HISTORY,
    f"{PICTURES}/*.png",
    f"{PARAVIEW}/*.vtu",
    f"{PARAVIEW}/*.pvd",
)
"""Patterns of all files that depend on the run; an earlier run's are deleted by these."""

_POLYGONS = ("points", "ring_offsets", "polygon_offsets")


def frame_name(index: int) -> str:
    """Return the file name of a frame inside the folder of frames."""
    return f"{index:06d}.npz"


def topology_name(number: int) -> str:
    """Return the file name of a topology: `topology.npz`, then `topology_1.npz`, ..."""
    return f"topology_{number}.npz" if number else "topology.npz"


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file so that readers, and a kill at any moment, see the old or the new content."""
    scratch = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    scratch.write_bytes(content)
    os.replace(scratch, path)


def write_text(path: Path, content: str) -> None:
    """Write a text file as `write_bytes` does."""
    write_bytes(path, content.encode())


def write_arrays(path: Path, arrays: Mapping[str, npt.ArrayLike]) -> None:
    """Write an .npz as `write_bytes` does; the same arrays give the same bytes."""
    buffer = io.BytesIO()
    named: dict[str, Any] = {name: np.asarray(array) for name, array in arrays.items()}
    np.savez(buffer, **named)
    write_bytes(path, buffer.getvalue())


def read_arrays(path: Path) -> dict[str, npt.NDArray[Any]]:
    """Read all arrays of an .npz."""
    with np.load(path, allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def write_frame(path: Path, frame: Frame) -> None:
    """Write one frame."""
    write_arrays(path, vars(frame))


def read_frame(path: Path) -> Frame:
    """Read one frame."""
    stored: dict[str, Any] = read_arrays(path)
    return Frame(**{name: a.item() if a.ndim == 0 else a for name, a in stored.items()})


def write_topology(path: Path, topology: Topology) -> None:
    """Write one topology."""
    arrays = {name: getattr(topology.elements, name) for name in _POLYGONS}
    arrays |= {"element_region": topology.element_region}
    arrays |= {"region_material": topology.region_material}
    arrays |= {"material_names": np.array(topology.material_names, dtype=np.str_)}
    arrays |= {"region_names": np.array(topology.region_names, dtype=np.str_)}
    write_arrays(path, arrays)


def read_topology(path: Path) -> Topology:
    """Read one topology."""
    stored = read_arrays(path)
    return Topology(
        elements=Polygons(*(stored[name] for name in _POLYGONS)),
        element_region=stored["element_region"],
        region_material=stored["region_material"],
        material_names=tuple(str(name) for name in stored["material_names"]),
        region_names=tuple(str(name) for name in stored["region_names"]),
    )
