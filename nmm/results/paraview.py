"""ParaView files of a run: one .vtu a frame and the .pvd that puts them at their times.

`blocks.pvd` holds the elements at their place before the run, so that *Warp By Vector* with
`displacement` and factor 1 shows them where they are; points are not shared between elements, so
openings show. `contacts.pvd` holds the contact points where they are, with their forces.
"""

import os
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from integration.arrays import Floats
from nmm.results.cells import Cells, cells
from nmm.results.files import write_text
from nmm.results.frame import Frame, Topology
from nmm.results.sink import RunData
from nmm.results.vtu import POLYGON, TRIANGLE, VERTEX, collection, in_space, unstructured_grid

STRESS = {"stress": ("xx", "yy", "xy")}


def write_paraview(run: RunData, folder: str | os.PathLike[str]) -> list[Path]:
    """Write all frames of a run for ParaView.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    folder
        Where the files go; made when missing.

    Returns
    -------
    list of Path
        The files to open: `blocks.pvd` and, when the run has contact points, `contacts.pvd`.
    """
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    cut = [cells(topology.elements) for topology in run.topologies]
    times = output_times(run.frames)

    def block_text(frame: Frame) -> str:
        return blocks_grid(frame, run.topologies[frame.topology], cut[frame.topology])

    opened = [_write_series(target, "blocks", run.frames, times, block_text)]
    if any(len(frame.contact_gap) for frame in run.frames):
        opened.append(_write_series(target, "contacts", run.frames, times, contacts_grid))
    return opened


def output_times(frames: Sequence[Frame]) -> list[float]:
    """Return the times of frames, s; their numbers where time does not grow from frame to frame.

    Viewers take two files at one time for two parts of one state.
    """
    times = [frame.time for frame in frames]
    if any(late <= early for early, late in pairwise(times)):
        return [float(number) for number in range(len(times))]
    return times


def _write_series(
    folder: Path,
    name: str,
    frames: Sequence[Frame],
    times: Sequence[float],
    text: Callable[[Frame], str],
) -> Path:
    names = [f"{name}_{number:06d}.vtu" for number in range(len(frames))]
    for file, frame in zip(names, frames, strict=True):
        write_text(folder / file, text(frame))
    write_text(folder / f"{name}.pvd", collection(times, names))
    return folder / f"{name}.pvd"


def blocks_grid(frame: Frame, topology: Topology, cut: Cells) -> str:
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
        },
        cell_data={
            "stress": frame.stress[cut.polygon],
            "block": topology.element_region[cut.polygon],
            "material": topology.element_material[cut.polygon],
        },
        components=STRESS,
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
        },
        cell_data={},
        components={},
    )


def contact_vectors(frame: Frame) -> Floats:
    """(C, 2) force on side b at each contact point, N."""
    normal = frame.contact_normal
    tangent = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
    force: Floats = frame.contact_force[:, :1] * normal + frame.contact_force[:, 1:] * tangent
    return force
