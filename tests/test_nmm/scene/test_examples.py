"""The example scenes are read, and their geometry is that of their descriptions."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from nmm.geometry import Regions, regions
from nmm.scene import Scene, read_scene

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
# A scene says what plane it is in; formulations and studies stand beside scenes.
FILES = sorted(EXAMPLES.rglob("*.toml"))
SCENES = [path for path in FILES if "plane" in tomllib.loads(path.read_text())]


def _read(name: str) -> tuple[Scene, Regions]:
    scene = read_scene(EXAMPLES / name)
    return scene, regions(scene)


def test_there_are_scenes() -> None:
    assert len(SCENES) >= 6


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_every_example_is_read_and_has_a_description(path: Path) -> None:
    scene = read_scene(path)
    assert scene.title
    assert len(regions(scene)) > 0
    folder = next(one for one in path.parents if (one / "README.md").exists())
    told = (folder / "README.md").read_text()
    assert path.name in told or path.parent.name in told


@pytest.mark.parametrize("blocks", [130, 455])
def test_the_beam_is_filled_by_the_blocks_its_name_says(blocks: int) -> None:
    scene, whole = _read(f"kitoh_beam/kitoh_{blocks}.toml")
    assert len(whole) == blocks
    assert whole.polygons.areas.sum() == pytest.approx(0.4 * 0.1, rel=1e-12)
    # 1 kN at factor 1: traction x length x thickness of both plates.
    total = sum(
        load.traction[1] * (load.segment[1][0] - load.segment[0][0]) * scene.thickness
        for load in scene.loads
        if load.traction is not None and load.segment is not None
    )
    assert total == pytest.approx(-1000.0, rel=1e-12)
    points = {tuple(point) for point in whole.polygons.points.tolist()}
    assert {(0.05, 0.0), (0.35, 0.0), (0.145, 0.1), (0.255, 0.1)} <= points


def test_the_beam_has_the_strengths_of_the_paper_in_giga_pascals() -> None:
    scene, _ = _read("kitoh_beam/kitoh_130.toml")
    joint = scene.interface("concrete", "concrete")
    assert (joint.cohesion, joint.tensile_strength) == (4.7e6, 2.9e6)
    assert scene.materials["concrete"].young_modulus == 27.5e9
    assert joint.friction_angle == pytest.approx(np.radians(37), rel=1e-15)


def test_the_reinforced_beam_has_a_bar_of_forty_pieces_in_455_blocks() -> None:
    scene, whole = _read("kitoh_beam/kitoh_reinforced.toml")
    bar = whole.select("bar")
    assert len(whole) == 455
    assert len(bar) == 40
    assert whole.polygons.areas.sum() == pytest.approx(0.04, rel=1e-12)
    assert whole.polygons.areas[bar].sum() == pytest.approx(0.4 * 0.004, rel=1e-12)
    assert scene.interface("concrete", "steel").cohesion == 1.88e6
    assert scene.interface("concrete", "concrete").cohesion == 4.7e6


@pytest.mark.parametrize("name", ["rest", "slide"])
def test_the_block_lies_on_the_slope(name: str) -> None:
    scene, whole = _read(f"incline/{name}.toml")
    corners = whole.polygons.take([1]).points
    normal = np.array([-0.5, np.sqrt(0.75)])
    assert np.sort(corners @ normal) == pytest.approx([0, 0, 1, 1], abs=4e-16)
    assert whole.polygons.areas[1] == pytest.approx(1.0, rel=1e-15)
    assert scene.materials["rock"].density == 2600.0


def test_the_sliding_block_carries_the_way_it_must_go() -> None:
    scene, _ = _read("incline/slide.toml")
    way = 0.5 * 9.81 * (0.5 - np.sqrt(0.75) * np.tan(np.radians(20)))
    x, y = (item.value for item in scene.references)
    # Stored with eight digits.
    assert [x, y] == pytest.approx([-way * np.sqrt(0.75), -way / 2], abs=1e-8)
