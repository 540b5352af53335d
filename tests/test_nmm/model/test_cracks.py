"""Stress intensity factors beside those of benchmarks A10 to A12."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

import nmm
from integration.polygons import Polygons
from nmm.assembly.places import on_edges
from nmm.errors import NmmError
from nmm.formulation import CoverTable
from nmm.fracture.stress_intensity import stress_intensity
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.verification.continuum import Problem, load, on_mesh
from nmm.verification.problems.cracks.stationary_cracks import LAW, EdgeCrack


@dataclass(frozen=True)
class FineCrack(EdgeCrack):
    size: ClassVar[float] = 0.05


def test_pressure_on_the_faces_is_tension_at_the_ends() -> None:
    # Superposition: the uniform stress between the two states has no intensity.
    case = EdgeCrack()
    (pulled,) = case.tips("manifold", 0, 0.2)
    problem = case.problem(on_mesh("manifold", 0.1))
    model = problem.model
    faces = model.manifold.boundary.crack >= 0  # type: ignore[attr-defined]
    pressure = load(model, on_edges(model.manifold, faces, 10), lambda p, n: -n)
    found = Problem(model, problem.supports, [pressure]).solve()
    pressed = stress_intensity(
        model,
        found.state.deformation,
        0,
        0.2,
        kappa=LAW.kolosov("strain"),
        face_traction=lambda p, n: -n,
    )
    assert pressed.opening == pytest.approx(pulled.opening, rel=2e-3)


MOUTH = """
plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
[[blocks]]
material = "m"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[cracks]]
name = "notch"
points = [[1, 1], [1, 0.3]]
[[supports]]
name = "foot"
segment = [[0, 0], [2, 0]]
fix = ["x", "y"]
[[loads]]
name = "weight"
kind = "point"
point = [1, {height}]
force = [0, -1e4]
[[monitors]]
name = "left"
point = [0.9, 0.9]
[[monitors]]
name = "right"
point = [1.1, 0.9]
[formulation.cover]
type = "quads"
size = 0.25
"""


@pytest.mark.parametrize("height", [1.0, 0.6])
def test_what_acts_at_a_point_of_a_crack_acts_on_both_faces(height: float) -> None:
    # The body is its own mirror image. One face, that of the first element, bore all of the load.
    found = nmm.run(nmm.parse_scene(MOUTH.format(height=height))).history
    for way, sign in (("ux", -1), ("uy", 1)):
        left, right = (found[f"monitor:{name}:{way}"][-1] for name in ("left", "right"))
        assert left == pytest.approx(sign * right, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("position", range(3))
def test_edge_crack_with_fine_covers_is_right_to_a_thousandth(position: int) -> None:
    case = FineCrack(0.5, 2.82546, 0.3, position)
    (found,) = case.tips("manifold", position, 0.3)
    assert found.opening == pytest.approx(2.82546 * np.sqrt(np.pi * 0.5), rel=1e-3)


def test_a_tip_that_does_not_exist_is_named() -> None:
    region = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])])
    model = solid(region, CoverTable(type="triangles", size=0.5), [Elastic(1.0, 0.3)], "stress")
    with pytest.raises(NmmError, match="crack tip 0: 0 tips"):
        stress_intensity(model, np.zeros(model.manifold.n_unknowns), 0, 0.1, kappa=2.0)
