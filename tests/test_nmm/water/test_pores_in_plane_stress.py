"""Pores of a free plate: their pressure acts in all three directions, and widens it across."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing.scenes import roller_and_pin

PRESSURE, BIOT, NU, E = 1e6, 0.8, 0.25, 1e9
ISOTROPIC = f"young_modulus = {E}\npoisson_ratio = {NU}\n"
WOOD = (
    'law = "orthotropic"\nyoung_modulus = 1e9\npoisson_ratio = 0.2\nyoung_modulus_2 = 2e9\n'
    "shear_modulus = 5e8\nyoung_modulus_3 = 5e8\npoisson_ratio_13 = 0.3\npoisson_ratio_23 = 0.1\n"
)


def plate(matter, plane="stress", seepage=""):
    """A plate of 2 m by 1 m whose pores are all at `PRESSURE`."""
    return nmm.parse_scene(
        f"""plane = "{plane}"
        [materials.stone]
        {matter}
        hydraulic_conductivity = 1e-6
        specific_storage = 1e-5
        biot = {BIOT}
        [[blocks]]
        name = "plate"
        material = "stone"
        vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
        {roller_and_pin()}
        [seepage]
        unit_weight = 1e4
        {seepage}
        [[heads]]
        name = "even"
        block = "plate"
        head = {PRESSURE / 1e4}
        gradient = [0, 1]
        [[monitors]]
        name = "corner"
        point = [2, 1]
        [formulation.cover]
        type = "triangles"
        size = 0.5
        degree = 1
        [formulation.supports]
        method = "lagrange"
        """,
        "plate",
    )


@pytest.mark.parametrize(
    ("matter", "strain"),
    [
        (ISOTROPIC, np.full(2, (1 - 2 * NU) / E)),
        (WOOD, np.array([(1 - 0.2 - 0.3) / 1e9, (1 - 0.1) / 2e9 - 0.2 / 1e9])),
    ],
)
def test_a_free_plate_swells_as_a_free_body_does(matter, strain):
    """By the compliance in space under ``b p`` in all directions; ``(1 - nu) / E`` was found."""
    run = nmm.run(plate(matter))
    found = [run.history["monitor:corner:ux"][-1] / 2, run.history["monitor:corner:uy"][-1]]
    assert found == pytest.approx(BIOT * PRESSURE * strain, rel=1e-8)
    assert np.abs(run.frames[-1].stress).max() < 1e-8 * PRESSURE


def test_in_plane_strain_it_widens_by_what_is_held_across_besides():
    run = nmm.run(plate(ISOTROPIC, "strain"))
    expected = 2 * BIOT * PRESSURE * (1 - 2 * NU) * (1 + NU) / E
    assert run.history["monitor:corner:ux"][-1] == pytest.approx(expected, rel=1e-8)


def test_matter_that_flows_is_refused_as_it_knows_of_no_stress_across():
    with pytest.raises(SceneError, match=r"plate:3: materials.stone.law: .*in plane stress"):
        nmm.run(plate(f'law = "von_mises"\nyield_stress = 1e6\n{ISOTROPIC}'))


def test_strain_that_squeezes_water_out_is_refused_in_plane_stress():
    with pytest.raises(SceneError, match=r"seepage.coupled: true in plane stress"):
        plate(ISOTROPIC, seepage="transient = true\ncoupled = true\ninitial = 1.0\nduration = 1.0")
