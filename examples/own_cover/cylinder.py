"""A thick cylinder under pressure (benchmark A6) on a net of one's own and on Shi's net."""

from pathlib import Path

import numpy as np

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.places import at_point, on_edges
from nmm.constraints.imposition import Method
from nmm.formulation import CoverTable, read_formulation
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.stepping.drive.linear_statics import equilibrium, hold, traction
from nmm.trust import allowing

HERE = Path(__file__).parent
INNER, OUTER, POISSON = 1.0, 2.0, 0.3


def quarter(sides: int = 128) -> Polygons:
    """A quarter of the ring; the arcs are polylines."""
    turn = np.linspace(0, np.pi / 2, sides + 1)
    arc = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    arc[[0, -1]] = [[1, 0], [0, 1]]
    return Polygons.from_vertices([np.concatenate([OUTER * arc, INNER * arc[::-1]])])


def lame() -> float:
    """Displacement of the inner wall, E = p = 1, plane strain (Lame)."""
    a, b, nu = INNER, OUTER, POISSON
    return (1 + nu) * a**2 / (b**2 - a**2) * ((1 - 2 * nu) * a + b**2 / a)


def wall(cover: CoverTable) -> tuple[float, int]:
    """Displacement of the inner wall and the number of unknowns."""
    model = solid(quarter(), cover, [Elastic(1.0, POISSON)], "strain")
    edges = model.manifold.boundary
    middle = (edges.start + edges.end) / 2
    bore = (np.hypot(*middle.T) < INNER + 1e-9) & (np.abs(middle).min(axis=1) > 1e-9)
    assert cover.size is not None
    method = Method("nitsche", cover.size, cover.degree or 0)
    effects = [
        hold(model, on_edges(model.manifold, middle[:, 0] < 1e-9), method, held=(True, False)),
        hold(model, on_edges(model.manifold, middle[:, 1] < 1e-9), method, held=(False, True)),
        traction(model, on_edges(model.manifold, bore), _pressure),
    ]
    found = equilibrium(model, effects)
    place = at_point(model.manifold, np.array([INNER, 0.0]))
    moved = place.points.rows.apply(found.state.deformation)
    return float(moved[0, 0]), model.manifold.n_unknowns


def _pressure(points: Floats, normals: Floats) -> Floats:
    return -normals


def main(size: float = 0.15) -> dict[str, tuple[float, int]]:
    """Return error and unknowns of the radial net and of Shi's net of like cells at the wall."""
    own = read_formulation(HERE / "radial.toml").cover.model_copy(update={"size": size})
    shi = CoverTable(type="triangles", size=size, degree=1, angle=0.2)
    found = {}
    with allowing("radial", folder=HERE):
        for name, cover in (("radial", own), ("triangles", shi)):
            moved, unknowns = wall(cover)
            found[name] = (moved / lame() - 1, unknowns)
    return found


if __name__ == "__main__":
    for name, (error, unknowns) in main().items():
        print(f"{name:12} {100 * error:8.4f} %  {unknowns} unknowns")
