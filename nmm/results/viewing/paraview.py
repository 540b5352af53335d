"""ParaView files of a run: one .vtu a frame and the .pvd that puts them at their times.

`blocks.pvd` holds the elements at their place before the run, so that *Warp By Vector* with
`displacement` and factor 1 shows them where they are; points are not shared between elements, so
openings show. `contacts.pvd` holds the contact points where they are, with their forces, and
`members.pvd` springs and bars where they are, with theirs. `cracks.pvd` holds the faces of cracks
that may grow as lines half way between both, with how far they are open and have slid, `tips.pvd`
their tips with the intensities.
"""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np

from integration.arrays import Floats
from integration.plane_vectors import clockwise
from nmm.errors import DamageError
from nmm.quantity import ENDS, SPOT, Quantity
from nmm.results.frame import Frame, Topology
from nmm.results.sink import RunData
from nmm.results.storage.writing import told, write_text
from nmm.results.viewing.cells import PolygonCells, cells
from nmm.results.viewing.vtu import (
    LINE,
    POLYGON,
    TRIANGLE,
    VERTEX,
    collection,
    in_space,
    unstructured_grid,
)

STRESS: dict[str, tuple[str, ...]] = {"stress": ("xx", "yy", "xy")}


def write_paraview(
    run: RunData,
    folder: str | os.PathLike[str],
    tell: Callable[[str], None] | None = None,
) -> list[Path]:
    """Write all frames of a run for ParaView.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    folder
        Where the files go; made when missing.
    tell
        Called with a sentence for each frame of a damaged run folder, which is left out. Without
        it the first such fault is raised.

    Returns
    -------
    list of Path
        The files to open: `blocks.pvd` and, when the run has any, `contacts.pvd`, `members.pvd`,
        `cracks.pvd` and `tips.pvd`.

    Raises
    ------
    StorageError
        When a file cannot be written.
    DamageError
        When a frame cannot be read and there is no ``tell``.
    """
    target = Path(folder)
    with told(target):
        target.mkdir(parents=True, exist_ok=True)
    cut: dict[int, PolygonCells] = {}
    times: list[float] = []
    # Texts of contacts and members where there are none; written once there are some.
    bare: dict[str, str] = {}
    some = set[str]()
    for frame, topology in _readable(run, tell):
        if frame.topology not in cut:
            cut[frame.topology] = cells(topology.elements)
        number = len(times)
        write_text(
            _file(target, "blocks", number), blocks_grid(frame, topology, cut[frame.topology])
        )
        times.append(frame.time)
        for name, (count, grid) in BESIDE.items():
            text = grid(frame)
            if name not in some and count(frame):
                some.add(name)
                for earlier in range(number):
                    write_text(_file(target, name, earlier), bare[name])
            if name in some:
                write_text(_file(target, name, number), text)
            bare.setdefault(name, text)
    names = ("blocks", *(name for name in BESIDE if name in some))
    return [_write_collection(target, name, output_times(times)) for name in names]


def _file(folder: Path, name: str, number: int) -> Path:
    return folder / f"{name}_{number:06d}.vtu"


def _readable(run: RunData, tell: Callable[[str], None] | None) -> Iterator[tuple[Frame, Topology]]:
    """Yield the frames that can be read with their topologies, and tell each fault once."""
    told_before = set[str]()
    for number in range(len(run.frames)):
        try:
            frame = run.frames[number]
            topology = run.topologies[frame.topology]
        except DamageError as fault:
            if tell is None:
                raise
            if str(fault) not in told_before:
                tell(str(fault))
                told_before.add(str(fault))
        else:
            yield frame, topology


def output_times(times: Sequence[float]) -> list[float]:
    """Return the times of frames, s; their numbers where time does not grow from frame to frame.

    Viewers take two files at one time for two parts of one state.
    """
    if any(late <= early for early, late in pairwise(times)):
        return [float(number) for number in range(len(times))]
    return list(times)


def _write_collection(folder: Path, name: str, times: Sequence[float]) -> Path:
    names = [_file(folder, name, number).name for number in range(len(times))]
    write_text(folder / f"{name}.pvd", collection(times, names))
    return folder / f"{name}.pvd"


def blocks_grid(frame: Frame, topology: Topology, cut: PolygonCells) -> str:
    """Return the .vtu text of the elements of a frame."""
    sizes = np.diff(cut.offsets, prepend=0)
    return unstructured_grid(
        points=frame.points - frame.displacement,
        connectivity=cut.connectivity,
        offsets=cut.offsets,
        types=np.where(sizes == 3, TRIANGLE, POLYGON).astype(np.uint8),
        point_data={
            "displacement": in_space(frame.displacement),
            "velocity": in_space(frame.velocity),
            **{name: _shown(one.values) for name, one in frame.on("points").items()},
        },
        cell_data={
            "stress": frame.stress[cut.polygon],
            "block": topology.element_region[cut.polygon],
            "material": topology.element_material[cut.polygon],
            **{n: _shown(q.values)[cut.polygon] for n, q in frame.on("elements").items()},
        },
        components=STRESS | _components(frame),
    )


def contacts_grid(frame: Frame) -> str:
    """Return the .vtu text of the contact points of a frame.

    `force` is the force on side b, N n + T t with the normal n from side b to side a, t a quarter
    turn clockwise from it, and N positive in tension.
    """
    number = np.arange(len(frame.contact_gap))
    return unstructured_grid(
        points=frame.contact_position,
        connectivity=number,
        offsets=number + 1,
        types=np.full(len(number), VERTEX, dtype=np.uint8),
        point_data={
            "force": in_space(contact_vectors(frame)),
            "normal_force": frame.contact_force[:, 0],
            "shear_force": frame.contact_force[:, 1],
            "gap": frame.contact_gap,
            "state": frame.contact_state,
            **{name: _shown(one.values) for name, one in frame.on("contacts").items()},
        },
        cell_data={},
        components=_components(frame),
    )


def segments_grid(frame: Frame, place: str) -> str:
    """Return the .vtu text of the members of a frame, or of its cracks: a line a segment."""
    known = frame.on(place)
    ends = _where(frame, place, ENDS).reshape(-1, 2)
    number = np.arange(len(ends) // 2)
    return unstructured_grid(
        points=ends,
        connectivity=np.arange(len(ends)),
        offsets=2 * (number + 1),
        types=np.full(len(number), LINE, dtype=np.uint8),
        point_data={},
        cell_data=_carried(known, ENDS),
        components={},
    )


def tips_grid(frame: Frame) -> str:
    """Return the .vtu text of the crack tips of a frame."""
    points = _where(frame, "tips", SPOT)
    number = np.arange(len(points))
    return unstructured_grid(
        points=points,
        connectivity=number,
        offsets=number + 1,
        types=np.full(len(number), VERTEX, dtype=np.uint8),
        point_data=_carried(frame.on("tips"), SPOT),
        cell_data={},
        components={},
    )


def _where(frame: Frame, place: str, components: tuple[str, ...]) -> Floats:
    """Where segments or points of a frame are, a row each."""
    found = [one.values for one in frame.on(place).values() if one.components == components]
    return found[0] if found else np.zeros((0, len(components)))


def _carried(known: Mapping[str, Quantity], where: tuple[str, ...]) -> dict[str, Floats]:
    """Return what segments or points carry, by its name without that of the effect."""
    return {
        name.partition(":")[2]: one.values for name, one in known.items() if one.components != where
    }


BESIDE: dict[str, tuple[Callable[[Frame], int], Callable[[Frame], str]]] = {
    "contacts": (lambda frame: len(frame.contact_gap), contacts_grid),
    "members": (
        lambda frame: len(_where(frame, "members", ENDS)),
        partial(segments_grid, place="members"),
    ),
    "cracks": (
        lambda frame: len(_where(frame, "cracks", ENDS)),
        partial(segments_grid, place="cracks"),
    ),
    "tips": (lambda frame: len(_where(frame, "tips", SPOT)), tips_grid),
}
"""What lies beside the blocks in files of its own: how many of it a frame has, and its text."""


def _shown(values: Floats) -> Floats:
    """Return values as viewers expect them: pairs without names are vectors in space."""
    return in_space(values) if values.ndim == 2 and values.shape[1] == 2 else values


def _components(frame: Frame) -> dict[str, tuple[str, ...]]:
    """Return the names of components of the further quantities that have some."""
    return {name: one.components for name, one in frame.fields.items() if one.components}


def contact_vectors(frame: Frame) -> Floats:
    """(C, 2) force on side b at each contact point, N."""
    normal = frame.contact_normal
    tangent = clockwise(normal)
    force: Floats = frame.contact_force[:, :1] * normal + frame.contact_force[:, 1:] * tangent
    return force
