"""Settings of all tests, and a made-up run for the tests of results, plots and command line."""

import gc
import importlib.util
import os
import sys
from pathlib import Path

os.environ.setdefault("MPLBACKEND", "Agg")
os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
import pytest
import shapely
from hypothesis import settings
from hypothesis.internal.conjecture import providers

# Examples come from their strategies, not from numbers in all sources that happen to be imported:
# finding those took every process 15 s, and which ones there were hung on the tests run before.
providers.is_local_module_file = lambda path: False
settings.register_profile("nmm", deadline=None, derandomize=True, max_examples=50)
settings.load_profile("nmm")

LENGTH, DEPTH = 0.4, 0.1


def pytest_collection() -> None:
    """Thousands of tests and modules are made and none is dropped: a fifth of it was searches."""
    gc.disable()


def pytest_collection_finish() -> None:
    """What stays to the end is not looked at again, nor counts where a search is due.

    Searches of all objects wait until as many as a quarter of those of the last one are new: with
    the frozen ones among them, runs that are over would fill the memory.
    """
    gc.collect()
    gc.freeze()
    gc.collect()
    gc.enable()


def voronoi_beam(blocks, seed=1):
    """Polygons of Voronoi cells of a beam, and the shared edges (j, 2, 2) with their two cells."""
    points = np.random.default_rng(seed).uniform((0, 0), (LENGTH, DEPTH), (blocks, 2))
    beam = shapely.box(0, 0, LENGTH, DEPTH)
    for _ in range(4):  # Lloyd's iteration makes cells of like size
        diagram = shapely.voronoi_polygons(shapely.MultiPoint(points), extend_to=beam, ordered=True)
        cells = shapely.intersection(np.array(shapely.get_parts(diagram)), beam)
        points = shapely.get_coordinates(shapely.centroid(cells))
    first, second = shapely.STRtree(cells).query(cells, predicate="touches")
    once = first < second
    first, second = first[once], second[once]
    shared = shapely.intersection(cells[first], cells[second])
    edge = (shapely.get_type_id(shared) == 1) & (shapely.length(shared) > 1e-9)
    ends = shapely.get_coordinates(shared[edge]).reshape(-1, 2, 2)
    return cells, ends, np.stack([first[edge], second[edge]], axis=1)


def cracked_frame(index, frame_type, elements, ends, pairs):
    """A beam whose halves turn about the middle of the top, by an angle growing with index."""
    angle = 2e-4 * index
    centre = np.array([LENGTH / 2, DEPTH])
    side = np.sign(elements.centroids[:, 0] - LENGTH / 2)

    def moved(points, sides):
        arm = points - centre
        return (angle * sides)[:, None] * np.stack([-arm[:, 1], arm[:, 0]], axis=1)

    displacement = moved(elements.points, side[elements.polygon_of_point])
    bending = (elements.centroids[:, 1] - DEPTH / 2) * -6e7 * min(index, 3)
    stress = np.stack([bending, 0.1 * bending, 2e5 * side], axis=1)
    corners, owners = ends.reshape(-1, 2), np.repeat(pairs, 2, axis=0)
    tangent = np.repeat(ends[:, 1] - ends[:, 0], 2, axis=0)
    length = np.hypot(*tangent.T)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1) / length[:, None]
    between = elements.centroids[owners[:, 0]] - elements.centroids[owners[:, 1]]
    normal *= np.sign(np.sum(normal * between, axis=1))[:, None]
    apart = (side[owners[:, 0]] != side[owners[:, 1]]) & (index > 1)
    jump = moved(corners, side[owners[:, 0]]) - moved(corners, side[owners[:, 1]])
    pull = bending[owners[:, 0]] * length / 2 * np.abs(normal[:, 0]) * 0.01
    shear = pull * normal[:, 1]
    return frame_type(
        index=index,
        time=0.1 * index,
        load_factor=0.5 * index,
        stage="failure" if index > 1 else "load",
        points=elements.points + displacement,
        displacement=displacement,
        velocity=np.zeros_like(displacement),
        stress=stress,
        contact_position=corners + moved(corners, side[owners[:, 1]]),
        contact_normal=normal,
        contact_length=length / 2,
        contact_force=np.where(apart, 0.0, np.stack([pull, shear])).T.copy(),
        contact_gap=np.where(apart, np.sum(jump * normal, axis=1), 0.0),
        contact_state=np.where(apart, 4, 3),
    )


def made_up_run(sink, blocks=40, frames=4):
    """Write a run of a beam that breaks in the middle into a sink."""
    from integration.polygons import Polygons
    from nmm.results import Frame, Summary, Topology

    cells, ends, pairs = voronoi_beam(blocks)
    elements = Polygons.from_shapely(cells)
    material = (elements.centroids[:, 1] < 0.02).astype(np.int64)
    names = tuple(f"cell {n}" for n in range(blocks))
    sink.begin(Topology(elements, np.arange(blocks), material, ("concrete", "mortar"), names))
    for index in range(frames):
        sink.frame(cracked_frame(index, Frame, elements, ends, pairs))
        factor = 0.5 * index
        sink.row(
            {
                "time": 0.1 * index,
                "load_factor": factor,
                "step": index,
                "residual": 1e-9 * index,
                "monitor:middle:ux": 0.0,
                "monitor:middle:uy": -1e-5 * factor * (1 + 0.1 * factor**2),
                "bonded": 2 * len(pairs) - index,
                "broken": index,
            }
        )
    sink.finish(
        Summary(
            status="failed_load",
            sentence="no equilibrium above load factor 1.5: a crack runs through the beam",
            title="made-up beam",
            blocks=blocks,
            elements=blocks,
            unknowns=6 * blocks,
            steps=frames,
            passes=3 * frames,
            seconds={"geometry": 0.1, "contact": 0.25, "solving": 0.5},
            failure_load=9240.0,
            failure_factor=1.5,
            failure_tolerance=0.005,
            largest_contacts={"bonded": 2 * len(pairs), "broken": frames, "open": 0},
            scene_hash="0123456789abcdef",
        )
    )
    return sink


@pytest.fixture(scope="session")
def write_run():
    """The function that writes a made-up run into a sink."""
    return made_up_run


BAR = """
title = "bar"
plane = "stress"
[materials.m]
young_modulus = 1.0
poisson_ratio = {poisson}
[[blocks]]
material = "m"
vertices = [[0, 0], [{length}, 0], [{length}, 1], [0, 1]]
[[supports]]
name = "wall"
segment = [[0, 0], [0, 1]]
fix = {fix}
[[loads]]
name = "pull"
kind = "edge"
segment = [[{length}, 0], [{length}, 1]]
traction = {traction}
"""


def bar(length=4, poisson=0.3, fix='["x", "y"]', traction="[1e-3, 0]", more="", law=None):
    """The text of a scene: a bar of modulus 1 and depth 1, held at its left end, pulled right."""
    text = BAR.format(length=length, poisson=poisson, fix=fix, traction=traction) + more
    return text.replace("[materials.m]", f'[materials.m]\nlaw = "{law}"') if law else text


@pytest.fixture(scope="session")
def bar_text():
    """The function that writes the scene of a bar."""
    return bar


@pytest.fixture(scope="session")
def script():
    """The function that runs a file of Python and returns it as a module."""

    def run(path):
        spec = importlib.util.spec_from_file_location(path.stem, path)
        module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return run


@pytest.fixture
def benchmarks(monkeypatch):
    """Modules of the folder benchmarks can be imported, anew in every test."""
    folder = Path(__file__).resolve().parents[1] / "benchmarks"
    monkeypatch.syspath_prepend(str(folder))
    yield
    for path in folder.glob("*.py"):
        sys.modules.pop(path.stem, None)


@pytest.fixture(scope="session")
def projectile():
    """The text of a scene: a square thrown with a spin, in free flight."""
    return """
plane = "stress"
duration = 1.0
[inertia]
[gravity]
[materials.m]
young_modulus = 1e7
poisson_ratio = 0.3
density = 1000
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[initial_velocities]]
block = "b"
velocity = [3, 4]
angular_velocity = 2.0
"""


@pytest.fixture(scope="session")
def memory_run():
    """A made-up run of 40 Voronoi blocks and 4 frames in memory."""
    from nmm.results import MemorySink

    return made_up_run(MemorySink())
