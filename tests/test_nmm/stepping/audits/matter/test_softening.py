"""Bands that soften across rows of cells, and cells too large under pressure, are told."""

import numpy as np
import pytest

import nmm
from nmm.verification.problems.matter.softening_layer import sheared_layer

SCENE = """plane = "strain"
[materials.clay]
law = "{law}"
young_modulus = 1e9
poisson_ratio = 0.25
{strength}
softening_energy = 2e3
[formulation.cover]
type = "{cover}"
size = 0.125
degree = 1
angle = "{angle} deg"
""" + "".join(sheared_layer("clay", (1.0, 1.0), 0.003, 5e4, 0.05))
LAWS = {
    "von_mises": "yield_stress = 1e6",
    "mohr_coulomb": "cohesion = 5.5e5\nfriction_angle = 0.2",
}


@pytest.mark.parametrize(
    ("law", "cover", "angle"),
    [
        ("von_mises", "quads", 0),
        ("mohr_coulomb", "quads", 0),
        ("mohr_coulomb", "quads", 25),
        ("von_mises", "triangles", 15),
        pytest.param("von_mises", "quads", 25, marks=pytest.mark.slow),
        pytest.param("mohr_coulomb", "triangles", 15, marks=pytest.mark.slow),
    ],
)
def test_bands_of_a_sheared_layer_lean_against_the_rows_of_its_cells(law, cover, angle):
    scene = SCENE.format(law=law, strength=LAWS[law], cover=cover, angle=angle)
    found = nmm.run(nmm.parse_scene(scene)).summary
    assert found.status == "converged", found.sentence
    # All of it is sheared along its foot, but for some degrees where strain turns within a band.
    leans = found.audits["softening_across_cells"]
    assert leans == pytest.approx(np.radians(angle), abs=np.radians(3.5))
    warned = [line for line in found.warnings if "audit softening_across_cells" in line]
    assert bool(warned) is (angle > 0)


@pytest.mark.parametrize(("pressure", "energy"), [(1e6, 2e3), (1e7, 250)])
def test_friction_that_falls_in_cells_too_large_for_the_pressure_is_told(pressure, energy):
    """Cells below ``2 G_f G / (c cos phi)^2`` without pressure, which adds strength to ``c``."""
    left = "\nresidual_friction_angle = 0.0\ntensile_strength = 1e5"
    strength, sides = LAWS["mohr_coulomb"] + left, ""
    for name, x, push in (("left", 0, pressure), ("right", 1, -pressure)):
        sides += f"""[[loads]]
            name = "press {name}"
            kind = "edge"
            segment = [[{x}, 0], [{x}, 1]]
            traction = [{push}, 0]
            """
    scene = SCENE.format(law="mohr_coulomb", strength=strength, cover="quads", angle=0)
    scene = scene.replace("degree = 1", "degree = 0").replace("size = 0.125", "size = 0.25")
    yields = (5.5e5 + pressure * np.tan(0.2)) * np.cos(0.2) / 4e8
    scene = scene.replace("2e3", f"{energy}").replace("0.003", f"{1.002 * yields}")
    stress = f"""[[initial_stresses]]
        block = "layer"
        stress = [-{pressure}, -{pressure}, 0]
        across = -{pressure}
        """
    found = nmm.run(nmm.parse_scene(scene + sides + stress)).summary
    assert found.status == "converged", found.sentence
    largest = 2 * energy * 4e8 / (5.5e5 * np.cos(0.2)) ** 2 / (1 + pressure * np.tan(0.2) / 5.5e5)
    share = found.audits["softening_under_pressure"]
    # Weight aside and the fall of the mean stress change the pressure.
    assert share == pytest.approx(0.25 / largest, rel=0.05)
    warned = [line for line in found.warnings if "audit softening_under_pressure" in line]
    assert bool(warned) is (share > 1)
