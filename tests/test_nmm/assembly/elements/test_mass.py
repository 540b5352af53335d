"""Lumped mass: a block for each cover, exact momentum, frequencies and waves."""

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.errors import FormulationError
from nmm.formulation import CoverTable, EnrichmentTable, parse_formulation
from nmm.geometry.tessellation.cover_types import named_functions
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification.free_modes import lowest_modes
from nmm.verification.problems.motion.waves import BarWave

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
DENSITY = 3.0


def model(cover: CoverTable, density: float = DENSITY, crack: bool = False) -> Model:
    cracks = [[[-0.1, 0.52], [0.47, 0.5]]] if crack else []
    law = [Elastic(1.0, 0.3)]
    return solid(SQUARE, cover, law, "stress", density=[density], lumped=True, cracks=cracks)


COVERS = [
    CoverTable(type="triangles", size=0.3, degree=1, angle=0.3, shift=(0.2, 0.3)),
    CoverTable(type="triangles", size=0.3, degree=3, angle=0.3, shift=(0.2, 0.3)),
    CoverTable(type="quads", size=0.25, degree=2),
    CoverTable(type="bspline", size=0.3, degree=1, angle=0.3),
    CoverTable(type="triangles", size=0.3, functions="rigid_strain"),
]
CONSTANT = [
    CoverTable(type="triangles", size=0.2, degree=0, angle=0.3),
    CoverTable(type="bspline", size=0.3, degree=0, angle=0.3),
]


def named(cover: CoverTable) -> str:
    return f"{cover.type}{named_functions(cover)[0]}{cover.degree}"


@pytest.mark.parametrize("cover", [*COVERS, *CONSTANT], ids=named)
def test_no_cover_is_coupled_with_another(cover: CoverTable) -> None:
    one = model(cover)
    owner = np.repeat(np.arange(one.manifold.n_covers), np.diff(one.manifold.cover_offset))
    row, column = one.mass.tocoo().coords
    assert (owner[row] == owner[column]).all()
    assert abs(one.mass - one.mass.T).max() == 0


@pytest.mark.parametrize("cover", COVERS, ids=named)
def test_mass_and_both_momenta_of_any_velocity_are_exact(cover: CoverTable) -> None:
    one = model(cover)
    modes = one.manifold.rigid_modes
    # rho A, and rho (1 + 1) / 12 about the middle.
    inertia = (modes.T @ (one.mass @ modes)).toarray()
    np.testing.assert_allclose(inertia, np.diag([3.0, 3.0, 0.5]), atol=1e-13)
    velocity = np.random.default_rng(2).normal(size=one.manifold.n_unknowns)
    momenta = modes.T @ (one.mass @ velocity)
    field = modes.T @ (one.consistent_mass @ velocity)
    np.testing.assert_allclose(momenta, field, atol=1e-12 * np.abs(velocity).sum())


@pytest.mark.parametrize("cover", CONSTANT, ids=named)
def test_constant_covers_have_the_row_sums(cover: CoverTable) -> None:
    one = model(cover)
    sums = np.asarray(one.consistent_mass.sum(axis=1)).ravel()
    np.testing.assert_allclose(one.mass.diagonal(), sums, rtol=1e-10)
    assert one.mass.nnz == one.manifold.n_unknowns
    assert one.mass.diagonal().sum() == pytest.approx(2 * DENSITY, rel=1e-12)


def test_singular_functions_have_mass_in_their_cover_and_momentum_stays_exact() -> None:
    cover = COVERS[0].model_copy(update={"enrichment": EnrichmentTable(radius=0.35)})
    one = model(cover, crack=True)
    assert one.manifold.enriched > 3
    modes = one.manifold.rigid_modes
    velocity = np.random.default_rng(2).normal(size=one.manifold.n_unknowns)
    momenta = modes.T @ (one.mass @ velocity)
    field = modes.T @ (one.consistent_mass @ velocity)
    np.testing.assert_allclose(momenta, field, rtol=1e-10, atol=1e-12)


def test_the_mass_of_a_block_is_the_same_lumped_or_not() -> None:
    one = model(CoverTable())
    np.testing.assert_allclose(
        one.mass.toarray(), one.consistent_mass.toarray(), rtol=1e-14, atol=1e-16
    )


@pytest.mark.parametrize(
    ("degree", "size", "tolerance"),
    # Measured -0.7 %, 0.27 %, 0.02 %.
    [(0, 0.125, 0.01), (1, 0.125, 5e-3), (2, 0.125, 1e-3)],
)
def test_lame_mode_and_three_rigid_motions_under_a_lumped_mass(
    degree: int, size: float, tolerance: float
) -> None:
    cover = CoverTable(type="triangles", size=size, degree=degree, angle=0.3, shift=(0.2, 0.3))
    one = model(cover, 1.0)
    modes = lowest_modes(one, 8)
    # Benchmark A14.
    assert (modes.frequency[:3] < 1e-3).all()
    assert (modes.frequency[3:] > 2.0).all()
    assert np.abs(modes.frequency - 2.755359030).min() < tolerance * 2.755


LUMPED = '[integrator]\ntype = "newmark"\nstep = 0.05\nmass = "lumped"\n'


@pytest.mark.parametrize(("degree", "size"), [(0, 0.2), (1, 0.3)])
def test_a_wave_arrives_in_time_and_doubles_at_the_end(degree: int, size: float) -> None:
    cover = f'[cover]\ntype = "triangles"\nsize = {size}\ndegree = {degree}\nangle = 0.3\n'
    found = run(BarWave().parsed(), parse_formulation(cover + LUMPED))
    assert found.summary.status == "converged", found.summary.sentence
    time, middle = found.history["time"], found.history["monitor:middle:ux"]
    # Benchmark B16.
    assert found.history["monitor:end:ux"][-1] == pytest.approx(2e-2, rel=0.02)
    behind = (time > 7) & (time < 12)
    slope, start = np.polyfit(time[behind], middle[behind], 1)
    assert -start / slope == pytest.approx(5.0, rel=0.02)
    assert abs(found.summary.energy_balance or 1.0) < 1e-3


@pytest.mark.parametrize("degree", [0, 1, 2])
def test_a_projectile_keeps_parabola_and_spin(degree: int, projectile: str) -> None:
    cover = f'[cover]\ntype = "triangles"\nsize = 0.4\ndegree = {degree}\nangle = 0.3\n'
    step = '[integrator]\ntype = "shi"\nstep = 0.02\nmass = "lumped"\n'
    stiff = projectile.replace("1e7", "1e10")
    found = run(parse_scene(stiff, "p"), parse_formulation(cover + step))
    assert found.summary.status == "converged", found.summary.sentence
    frames = found.state.frames
    # Benchmark B13.
    np.testing.assert_allclose(frames.centre[0], [3.5, 4.5 - 9.81 / 2], atol=1e-9)
    # Constant covers have 5 % too much inertia at this size and spin off axis: the turn stays. The
    # others turn slower by twice their mean strain, and up to a quarter of that more (B13).
    assert frames.angle[0] == pytest.approx(2.0 - 9.3e-8, abs=4e-8 if degree else 1e-3)


def test_weights_that_are_negative_have_no_lumped_mass() -> None:
    cover = CoverTable(type="mls", size=0.25, degree=1, options={"degree": 2})
    with pytest.raises(FormulationError, match='mass: "lumped": cover'):
        _ = model(cover).mass
