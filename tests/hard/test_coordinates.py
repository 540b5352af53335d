"""Every coordinate of a scene and of a formulation moves with the scene, whatever its key."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest
from pydantic import BaseModel

from covers.mathematical.base import Cover
from covers.mathematical.registry import COVERS, cover_class
from nmm.formulation import Formulation, parse_formulation
from nmm.model.origin import coordinate_fields, shifted
from nmm.scene import parse_scene, read_scene
from nmm.scene.model import Scene
from nmm.stepping.run import run

# Pairs in metres that are no places: ways.
POINTS = r"\[x, y\]( in m|, in m|\] in m)|\[\[x"
WAYS = {("SupportTable", "displacement")}


def models(kind: Any, seen: set[type]) -> Iterator[type[BaseModel]]:
    """Return a model and all models that its fields are made of."""
    if isinstance(kind, type) and issubclass(kind, BaseModel) and kind not in seen:
        seen.add(kind)
        yield kind
        for item in kind.model_fields.values():
            yield from models(item.annotation, seen)
    for part in get_args(kind):
        yield from models(part, seen)


ALL = [model for root in (Scene, Formulation) for model in models(root, set())]


def test_fields_described_as_points_are_coordinates_and_no_others() -> None:
    told = {
        (model.__name__, name)
        for model in ALL
        for name, item in model.model_fields.items()
        if re.search(POINTS, item.description or "")
    }
    marked = {(model.__name__, name) for model in ALL for name in coordinate_fields(model)}
    assert told - WAYS <= marked
    assert not marked & WAYS
    # The keys that are known to hold places; a new one joins by its type.
    known = {
        *("point", "points", "segment", "polygon", "corners"),
        *("vertices", "region", "holes", "keep", "origin"),
    }
    assert known <= {name for _, name in marked}


def test_options_of_covers_that_default_to_no_points_are_declared() -> None:
    from inspect import signature

    for name in COVERS:
        kind: type[Cover] = cover_class(name)
        parameters = signature(kind.regular).parameters  # type: ignore[attr-defined]
        hints = {key: str(one.annotation) for key, one in parameters.items()}
        points = {key for key, hint in hints.items() if "Sequence[float]]" in hint}
        assert points == set(kind.coordinates), name


def numbers(value: Any) -> list[float]:
    if isinstance(value, dict):
        return [number for item in value.values() for number in numbers(item)]
    if isinstance(value, list | tuple):
        return [number for item in value for number in numbers(item)]
    return [float(value)] if isinstance(value, float) else []


SCENES = [
    path
    for path in sorted((Path(__file__).parents[2] / "examples").rglob("*.toml"))
    if re.search(r"(?m)^(\[\[blocks\]\]|blocks =)", path.read_text(encoding="utf-8"))
]


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_shift_there_and_back_leaves_a_scene_as_it_was(path: Path) -> None:
    scene = read_scene(path)
    by = np.array([1024.0, -512.0])
    there = shifted(scene, by)
    back = shifted(there, -by)
    first, last = (np.array(numbers(one.model_dump())) for one in (scene, back))
    np.testing.assert_allclose(last, first, rtol=0, atol=1e-12)


CRACKED = """
plane = "strain"
[materials.a]
young_modulus = 1e10
poisson_ratio = 0.2
[[blocks]]
name = "b0"
material = "a"
vertices = {ring}
[[cracks]]
name = "c"
points = {crack}
[[supports]]
name = "s"
segment = {foot}
fix = ["x", "y"]
[[loads]]
name = "l"
kind = "edge"
segment = {top}
traction = [0, 1e6]
[[monitors]]
name = "m"
point = {corner}
"""
FORMULATIONS = {
    "focus": '[cover]\ntype = "graded"\nsize = 0.02\ndegree = 1\noptions = {{ focus = {tip} }}\n',
    "foci": '[cover]\ntype = "graded"\nsize = 0.04\ndegree = 0\n'
    "options = {{ focus = [{tip}, {corner}] }}\n",
    "region": '[cover]\ntype = "triangles"\nsize = 0.15\ndegree = 1\n'
    "[[cover.regions]]\ndegree = 2\npoint = {tip}\nradius = 0.2\n",
    "polygon": '[cover]\ntype = "triangles"\nsize = 0.15\ndegree = 0\n'
    "[[cover.regions]]\ndegree = 1\npolygon = [{tip}, {corner}, {top_right}]\n",
    "tips": '[cover]\ntype = "triangles"\nsize = 0.15\ndegree = 1\n'
    "[cover.enrichment]\nradius = 0.2\n",
}


@pytest.mark.parametrize("name", list(FORMULATIONS))
@pytest.mark.parametrize("place", [(1000.0, 0.0), (-4096.0, 777.25), (0.0, 1e6)])
def test_a_cracked_plate_far_away_moves_as_at_home(name: str, place: tuple[float, float]) -> None:
    def corner_moves(at: tuple[float, float]) -> np.ndarray:
        def moved(points: Any) -> Any:
            return (np.array(points) + at).tolist()

        where = {
            "ring": moved([[0, 0], [1, 0], [1, 1], [0, 1]]),
            "crack": moved([[0, 0.5], [0.375, 0.5]]),
            "foot": moved([[0, 0], [1, 0]]),
            "top": moved([[1, 1], [0, 1]]),
            "corner": moved([0.0, 1.0]),
            "top_right": moved([1.0, 1.0]),
            "tip": moved([0.375, 0.5]),
        }
        scene = parse_scene(CRACKED.format(**where), "scene")
        found = run(scene, parse_formulation(FORMULATIONS[name].format(**where)))
        assert found.summary.status == "converged"
        return np.array([found.history[f"monitor:m:{axis}"][-1] for axis in ("ux", "uy")])

    # Coordinates are binary fractions, so that the shift rounds nothing.
    np.testing.assert_allclose(corner_moves(place), corner_moves((0.0, 0.0)), rtol=1e-9)


BESIDE = """
plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
[interfaces.i]
friction_angle = "20 deg"
[[blocks]]
name = "load"
material = "m"
vertices = {load}
[[blocks]]
name = "wall"
material = "m"
vertices = {wall}
[[supports]]
name = "hold"
block = "wall"
fix = ["x", "y"]
[[supports]]
name = "held"
block = "load"
fix = ["x", "y"]
[contact]
"""


@pytest.mark.parametrize("cover", ["quads", "triangles"])
@pytest.mark.parametrize("angle", [0.3, 0.7])
def test_corners_on_a_face_far_away_cut_no_edges_of_the_size_of_rounding(
    cover: str, angle: float
) -> None:
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])

    def placed(points: Any) -> Any:
        return (np.array(points) @ turn + (1e4, -3e3)).tolist()

    # Coordinates of 1e4 m are rounded to 2e-12 m, so that the wall's corners miss the face by that.
    load = placed([[0, 0.6], [1, 0.3874], [1, 1.7], [0, 1.7]])
    wall = placed([[1, 0.9], [1.5, 0.9], [1.5, 1.6], [1, 1.6]])
    method = parse_formulation(f'[cover]\ntype = "{cover}"\nsize = 0.8\ndegree = 1\n')
    elements = run(parse_scene(BESIDE.format(load=load, wall=wall), "s"), method).topologies[0]
    edges = [
        np.hypot(*(np.roll(ring, -1, axis=0) - ring).T)
        for ring in np.split(elements.elements.points, elements.elements.ring_offsets[1:-1])
    ]
    # The shortest true edge is where cells of 0.8 m meet corners: millimetres.
    assert np.concatenate(edges).min() > 1e-6
