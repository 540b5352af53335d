"""ParaView files of a run: one .vtu a frame and the .pvd that puts them at their times.

`blocks.pvd` holds the elements at their place before the run, so that *Warp By Vector* with
`displacement` and factor 1 shows them where they are; points are not shared between elements, so
openings show. `contacts.pvd` holds the contact points where they are, with their forces, and
`members.pvd` springs and bars where they are, with theirs. `cracks.pvd` holds the faces of cracks
that may grow as lines half way between both, with how far they are open and have slid, `tips.pvd`
their tips with the intensities.
"""

import os
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from pathlib import Path

from nmm.errors import DamageError
from nmm.quantity import ENDS, SPOT
from nmm.results.frame import Frame, Topology
from nmm.results.sink import RunData
from nmm.results.storage.writing import told, write_text
from nmm.results.viewing.cells import PolygonCells, cells
from nmm.results.viewing.grids import blocks_grid, contacts_grid, placed, segments_grid, tips_grid
from nmm.results.viewing.vtu import collection


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


BESIDE: dict[str, tuple[Callable[[Frame], int], Callable[[Frame], str]]] = {
    "contacts": (lambda frame: len(frame.contact_gap), contacts_grid),
    "members": (
        lambda frame: len(placed(frame, "members", ENDS)),
        partial(segments_grid, place="members"),
    ),
    "cracks": (
        lambda frame: len(placed(frame, "cracks", ENDS)),
        partial(segments_grid, place="cracks"),
    ),
    "tips": (lambda frame: len(placed(frame, "tips", SPOT)), tips_grid),
}
"""What lies beside the blocks in files of its own: how many of it a frame has, and its text."""
