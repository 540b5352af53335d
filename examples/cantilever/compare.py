"""The cantilever of Timoshenko under many formulations, against its solution in closed form."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from integration.arrays import Floats
from nmm.assembly.errors import field_errors
from nmm.assembly.places import on_segment
from nmm.constraints.imposition import Method
from nmm.formulation import CoverTable, read_formulation
from nmm.geometry import regions
from nmm.geometry.tessellation.cover_types import highest_degree
from nmm.model.build import material_law
from nmm.model.from_polygons import solid
from nmm.scene import read_scene
from nmm.stepping.drive.linear_statics import equilibrium, hold, traction

HERE = Path(__file__).parent
LENGTH, DEPTH, FORCE, INERTIA = 48.0, 12.0, 1000.0, 144.0
MODULUS, POISSON = 3e7, 0.3


@dataclass(frozen=True)
class Answer:
    """Error in energy relative to the solution, strain energy, tip, and size of the system."""

    error: float
    energy: float
    tip: float
    unknowns: int


def displacement(points: Floats) -> Floats:
    """Exact displacement (m, 2) with the root's middle at rest (Timoshenko and Goodier 1951)."""
    x, y = points.T
    along = (6 * LENGTH - 3 * x) * x + (2 + POISSON) * (y**2 - DEPTH**2 / 4)
    bend = 3 * POISSON * y**2 * (LENGTH - x) + (3 * LENGTH - x) * x**2
    across = bend + (4 + 5 * POISSON) * DEPTH**2 * x / 4
    return np.asarray(FORCE / (6 * MODULUS * INERTIA) * np.stack([-y * along, across], axis=1))


def stress(points: Floats) -> Floats:
    """Exact stress (m, 3): linear bending stress, parabolic shear."""
    x, y = points.T
    shear = FORCE / (2 * INERTIA) * (DEPTH**2 / 4 - y**2)
    return np.stack([-FORCE * (LENGTH - x) * y / INERTIA, 0 * x, shear], axis=1)


def solve(cover: CoverTable) -> Answer:
    """Bend the beam of the scene under a formulation's cover."""
    scene = read_scene(HERE / "beam.toml")
    law = material_law(scene.materials["steel"])
    model = solid(regions(scene).polygons, cover, [law], scene.plane)
    assert cover.size is not None
    degree = highest_degree(cover)
    order = 2 * degree + 6
    root = on_segment(model.manifold, np.array([[0.0, -6.0], [0.0, 6.0]]), order=order)
    end = on_segment(model.manifold, np.array([[48.0, -6.0], [48.0, 6.0]]), order=order)
    held = hold(model, root, Method("nitsche", cover.size, degree), displacement)
    pull = traction(model, end, lambda p, n: stress(p)[:, [0, 2]])
    found = equilibrium(model, [held, pull])
    compliance = np.linalg.inv(law.stiffness(scene.plane))
    errors = field_errors(
        model, found.state.deformation, displacement, lambda p: stress(p) @ compliance, order
    )
    tip = end.points.rows.apply(found.state.deformation)[:, 1] @ end.weight / DEPTH
    return Answer(float(errors.energy), found.energy, float(tip), model.manifold.n_unknowns)


def main(size: float = 3.0, names: tuple[str, ...] = ()) -> dict[str, Answer]:
    """Return the answer of each formulation in the folder, or of those named, at a cell size."""
    files = sorted((HERE / "formulations").glob("*.toml"))
    chosen = [file for file in files if not names or file.stem in names]
    return {
        file.stem: solve(read_formulation(file).cover.model_copy(update={"size": size}))
        for file in chosen
    }


if __name__ == "__main__":
    print(f"{'formulation':24} {'unknowns':>8} {'error':>10} {'energy':>12} {'end':>12}")
    for name, one in main().items():
        print(f"{name:24} {one.unknowns:8} {one.error:10.2e} {one.energy:12.8f} {one.tip:12.5e}")
