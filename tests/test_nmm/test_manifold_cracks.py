"""Stress intensity factors on meshes that follow no crack."""

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.motion import initial_state
from nmm.assembly.places import at_point, on_edges, on_segment
from nmm.effects.support_methods import Springs
from nmm.effects.supports import Method, Supports
from nmm.errors import NmmError
from nmm.formulation import Cover, Enrichment
from nmm.fracture.stress_intensity import StressIntensity, stress_intensity
from nmm.materials.elastic import Elastic
from nmm.stepping.equilibrium import equilibrium, hold, traction
from nmm.stepping.solid import solid


def plate(
    width: float,
    crack: list[list[float]],
    cover: Cover,
    radius: float,
    pressure: bool = False,
) -> list[StressIntensity]:
    """Plate of height 2 under unit tension, or under unit pressure on the crack's faces."""
    left = -1.0 if crack[0][0] == -0.5 else 0.0
    region = Polygons.from_vertices(
        [np.array([[left, -1.0], [width, -1.0], [width, 1.0], [left, 1.0]])]
    )
    law = Elastic(1.0, 0.3)
    model = solid(region, cover, [law], "strain", cracks=[crack])
    edges = model.manifold.boundary
    y = (edges.start + edges.end)[:, 1] / 2
    if pressure:
        place = on_edges(model.manifold, edges.crack >= 0, 10)  # type: ignore[attr-defined]
        load = traction(model, place, lambda p, n: -n)
    else:
        place = on_edges(model.manifold, np.abs(y) > 1 - 1e-9, 10)
        load = traction(model, place, lambda p, n: np.stack([0 * p[:, 0], np.sign(p[:, 1])], 1))
    pins = [
        Springs(
            "pin",
            at_point(model.manifold, np.array(p)),
            np.array(held),
            lambda e: np.zeros(2),
            np.ones(1),
        )
        for p, held in (([width, 1.0], [True, True]), ([width, -1.0], [True, False]))
    ]
    supports = Supports(list(pins), model.manifold.n_unknowns, initial_state(model.manifold))
    found = equilibrium(model, [load, supports])
    assert found.residual < 1e-10
    assert model.cut is not None
    return [
        stress_intensity(
            model,
            found.state.deformation,
            tip,
            radius,
            kappa=law.kolosov("strain"),
            face_traction=(lambda p, n: -n) if pressure else None,
        )
        for tip in range(len(model.cut.tips))
    ]


def covers(size: float, degree: int, radius: float, position: int = 0) -> Cover:
    shift = [(0.13, 0.27), (0.71, 0.44), (0.35, 0.92)][position]
    return Cover(
        type="triangles",
        size=size,
        degree=degree,
        angle=0.2 + 0.3 * position,
        shift=shift,
        enrichment=Enrichment(radius=radius),
    )


@pytest.mark.parametrize(("length", "factor", "radius"), [(0.3, 1.66112, 0.2), (0.5, 2.82546, 0.3)])
def test_edge_crack_in_tension(length: float, factor: float, radius: float) -> None:
    (found,) = plate(1.0, [[-0.1, 0.0], [length, 0.0]], covers(0.1, 1, 0.2), radius)
    # Benchmark A10; measured 4e-4 and 1.1e-3 with 1,900 unknowns.
    assert found.opening == pytest.approx(factor * np.sqrt(np.pi * length), rel=3e-3)
    assert abs(found.sliding) < 1e-3 * found.opening
    stiff = 1 / (1 - 0.3**2)
    assert found.release_rate == pytest.approx(found.opening**2 / stiff, rel=1e-5)


def test_both_tips_of_a_centre_crack() -> None:
    found = plate(1.0, [[-0.5, 0.0], [0.5, 0.0]], covers(0.12, 1, 0.2), 0.3)
    assert len(found) == 2
    for tip in found:
        # Benchmark A11.
        assert tip.opening == pytest.approx(1.33371 * np.sqrt(np.pi * 0.5), rel=5e-3)
        assert abs(tip.sliding) < 2e-3 * tip.opening


def test_pressure_on_the_faces_is_tension_at_the_ends() -> None:
    # Superposition: the uniform stress between the two states has no intensity.
    (pulled,) = plate(1.0, [[-0.1, 0.0], [0.3, 0.0]], covers(0.1, 1, 0.2), 0.2)
    (pressed,) = plate(1.0, [[-0.1, 0.0], [0.3, 0.0]], covers(0.1, 1, 0.2), 0.2, pressure=True)
    assert pressed.opening == pytest.approx(pulled.opening, rel=2e-3)


@pytest.mark.slow
def test_edge_crack_whatever_the_position_of_the_mesh() -> None:
    errors = []
    for position in range(3):
        (found,) = plate(1.0, [[-0.1, 0.0], [0.5, 0.0]], covers(0.05, 1, 0.2, position), 0.3)
        errors.append(abs(found.opening / (2.82546 * np.sqrt(np.pi * 0.5)) - 1))
    assert max(errors) < 1e-3


def test_mixed_mode_of_a_sheared_edge_crack() -> None:
    # Benchmark A12c: bottom held, unit shear on top.
    region = Polygons.from_vertices([np.array([[0.0, -8.0], [7.0, -8.0], [7.0, 8.0], [0.0, 8.0]])])
    law = Elastic(3e7, 0.25)
    cover = Cover(
        type="triangles",
        size=0.8,
        degree=1,
        angle=0.2,
        shift=(0.1, 0.3),
        enrichment=Enrichment(radius=1.4),
    )
    model = solid(region, cover, [law], "strain", cracks=[[[-0.5, 0.0], [3.5, 0.0]]])
    bottom = on_segment(model.manifold, np.array([[0.0, -8.0], [7.0, -8.0]]), order=8)
    top = on_segment(model.manifold, np.array([[0.0, 8.0], [7.0, 8.0]]), order=8)

    def shear(p: Floats, n: Floats) -> Floats:
        return np.tile([1.0, 0.0], (len(p), 1))

    found = equilibrium(
        model, [hold(model, bottom, Method("nitsche", 0.8, 1)), traction(model, top, shear)]
    )
    k = stress_intensity(model, found.state.deformation, 0, 2.0, kappa=law.kolosov("strain"))
    assert k.opening == pytest.approx(34.0424, rel=5e-3)
    assert abs(k.sliding) == pytest.approx(4.5369, rel=1e-2)


def test_a_tip_that_does_not_exist_is_named() -> None:
    region = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])])
    model = solid(region, Cover(type="triangles", size=0.5), [Elastic(1.0, 0.3)], "stress")
    with pytest.raises(NmmError, match="crack tip 0: 0 tips"):
        stress_intensity(model, np.zeros(model.manifold.n_unknowns), 0, 0.1, kappa=2.0)
