"""What is said of crack tips and corners that are not as singular fields need them."""

from pathlib import Path

import numpy as np
import pytest

from nmm.errors import FormulationError, NmmError
from nmm.formulation import CoverTable, EnrichmentTable, parse_formulation
from nmm.fracture.stress_intensity import stress_intensity
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene.read import parse_scene
from nmm.stepping.run import run
from nmm.verification.continuum import polygon

PLATE = """
plane = "strain"
[materials.m]
young_modulus = 1.0
poisson_ratio = 0.3
[[blocks]]
name = "b"
material = "m"
vertices = [[0, -1], [1, -1], [1, 1], [0, 1]]
[[cracks]]
name = "c"
points = {crack}
[[loads]]
name = "up"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [0, 1.0]
[[supports]]
name = "floor"
segment = [[0, -1], [1, -1]]
fix = ["x", "y"]
"""
NET = """
[cover]
type = "triangles"
size = 0.1
angle = 0.4
shift = [0.37, 0.11]
degree = 1
"""


def kinked(angle: float, away: float) -> list[list[float]]:
    tip = [0.3 + away * np.cos(angle), away * np.sin(angle)]
    return [[0.0, 0.0], [0.3, 0.0], np.round(tip, 12).tolist()]


@pytest.mark.parametrize("radius", [0.0, 0.1, 0.3])
@pytest.mark.parametrize("angle", [0.4, np.pi / 4, -1.2])
def test_a_kink_in_the_covers_of_an_enriched_tip_is_told(angle: float, radius: float) -> None:
    how = parse_formulation(NET + f"[cover.enrichment]\nradius = {radius}\n")
    (warning,) = run(parse_scene(PLATE.format(crack=kinked(angle, 0.05))), how).summary.warnings
    assert "functions of a straight crack" in warning
    assert "40 % off" in warning
    # Far behind, and drawn as a curve of small pieces, it does no harm.
    assert not run(parse_scene(PLATE.format(crack=kinked(angle, 0.3))), how).summary.warnings


def test_a_straight_enriched_tip_is_not_told() -> None:
    how = parse_formulation(NET + "[cover.enrichment]\nradius = 0.3\n")
    found = run(parse_scene(PLATE.format(crack=[[0.0, 0.0], [0.3, 0.1]])), how)
    assert not found.summary.warnings


def test_explain_says_which_tips_carry_functions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from nmm.cli.scene_verbs import explain

    scene = tmp_path / "plate.toml"
    formulation = tmp_path / "net.toml"
    formulation.write_text(NET)
    for crack, said in (
        ([[0.0, 0.0], [0.3, 0.1]], "crack tip [0.3, 0.1]: carries tip functions"),
        (kinked(np.pi / 2, 0.05), "crack tip [0.3, 0.05]: without tip functions"),
    ):
        scene.write_text(PLATE.format(crack=crack))
        explain(scene, formulation, False)
        assert said in capsys.readouterr().out
    formulation.write_text(NET + "[cover.enrichment]\n")
    explain(scene, formulation, False)
    told = " ".join(capsys.readouterr().out.split())
    assert "carries tip functions, but the crack is not straight and alone" in told


SQUARE = polygon([[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]])


@pytest.mark.parametrize(
    ("cracks", "radius", "what", "distance"),
    [
        ([[[-0.1, 0.0], [0.3, 0.0]]], 0.6, "the boundary", "0.3 m"),
        ([[[-0.1, 0.0], [0.8, 0.0]]], 0.3, "the boundary", "0.2 m"),
        ([[[0.3, 0.0], [0.6, 0.0]]], 0.29, None, None),
        ([[[0.4, 0.0], [0.6, 0.0]]], 0.3, "another tip", "0.2 m"),
        ([[[-0.1, 0.4], [0.3, 0.0], [0.6, 0.0]]], 0.35, "a kink", "0.30"),
        ([[[-0.1, 0.0], [0.5, 0.0]], [[-0.1, 0.25], [1.1, 0.25]]], 0.3, "another crack", "0.25 m"),
    ],
)
def test_a_domain_that_holds_more_than_one_straight_crack_is_refused(
    cracks: list[list[list[float]]], radius: float, what: str | None, distance: str | None
) -> None:
    cover = CoverTable.model_validate({"type": "triangles", "size": 0.1, "angle": 0.2})
    model = solid(SQUARE, cover, [Elastic(1.0, 0.3)], "strain", cracks=cracks)
    still = np.zeros(model.manifold.n_unknowns)
    if what is None:
        assert stress_intensity(model, still, 0, radius, kappa=1.8).opening == 0.0
        return
    with pytest.raises(NmmError, match=what) as told:
        stress_intensity(model, still, 0, radius, kappa=1.8)
    assert str(distance) in str(told.value)


@pytest.mark.parametrize(
    ("corner", "angle"), [([0.0, -1.0], "90"), ([1.0, 1.0], "90"), ([0.5, 1.0], "180")]
)
def test_a_corner_that_is_not_re_entrant_is_refused(corner: list[float], angle: str) -> None:
    ring = [[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.5, 1.0], [0.0, 1.0]]
    cover = CoverTable.model_validate({"type": "triangles", "size": 0.3})
    named = cover.model_copy(
        update={"enrichment": EnrichmentTable(corners=((corner[0], corner[1]),))}
    )
    with pytest.raises(FormulationError, match=f"{angle} degrees"):
        solid(polygon(ring), named, [Elastic(1.0, 0.3)], "strain")
