"""Pictures of benchmark problems before they are solved."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.results.frame import Frame, Topology

if TYPE_CHECKING:
    from covers.cutting.cut_cells import CutCells
    from integration.polygons import Polygons
    from nmm.constraints.imposition import Imposition
    from nmm.effects.loading.loads import Load
    from nmm.scene import Scene


@dataclass(frozen=True)
class SceneSketch:
    """What a scene looks like before it is run, as pictures want it."""

    topologies: list[Topology]
    frames: list[Frame] = field(default_factory=list)
    history: dict[str, Floats] = field(default_factory=dict)


def sketch_scene(scene: "Scene", path: Path) -> None:
    """Draw blocks, supports and loads of a scene; blocks that are held are hatched."""
    from nmm.geometry.regions import regions
    from nmm.plots.problems import scene_problem

    found = regions(scene)
    topology = Topology(
        found.polygons,
        np.arange(len(found.polygons)),
        np.asarray(found.material),
        tuple(scene.materials),
        tuple(found.name),
    )
    whole = {one.block for one in scene.supports if not (one.point or one.segment)}
    held = [number for number, name in enumerate(found.name) if name in whole]
    scene_problem(SceneSketch([topology]), scene, held, path)


def sketch_solid(
    cut: "CutCells",
    supports: "Sequence[Imposition]",
    loads: "Sequence[Load]",
    path: Path,
) -> None:
    """Draw the elements of a meshed body, the points that are held and the tractions."""
    from nmm.plots.problems import DrawnTractions, solid_problem

    held = [one.interface.first.position for one in supports]
    solid_problem(
        cut,
        [
            DrawnTractions(
                one.place.position, one.force / one.place.weight[:, None], one.place.normal
            )
            for one in loads
            if one.place.normal is not None
        ],
        np.concatenate(held) if held else np.zeros((0, 2)),
        path,
    )


def sketch_polygons(polygons: "Polygons", path: Path) -> None:
    """Draw polygons alone."""
    from nmm.plots.problems import polygons_problem

    polygons_problem(polygons, path)
