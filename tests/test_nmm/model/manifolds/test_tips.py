"""What is said of crack tips and corners that are not as singular fields need them."""

from pathlib import Path

import numpy as np
import pytest

from covers.approximation.singular import enriched_fields
from nmm.errors import FormulationError, NmmError
from nmm.formulation import CoverTable, EnrichmentTable, parse_formulation
from nmm.fracture.stress_intensity import stress_intensity
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene.read import parse_scene
from nmm.stepping.run import run
from nmm.testing.cracked_plates import cracked_plate
from nmm.verification.continuum import polygon

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


@pytest.mark.parametrize("crack", [kinked(-1.2, 0.05), [[0.0, 0.0], [0.3, 0.1]]])
def test_tips_with_functions_are_no_news(crack: list[list[float]]) -> None:
    how = parse_formulation(NET + "[cover.enrichment]\nradius = 0.1\n")
    assert not run(parse_scene(cracked_plate(crack)), how).summary.warnings


@pytest.mark.parametrize(
    ("crack", "table"),
    [
        ([[0.0, 0.0], [0.3, 0.1]], "[cover.enrichment]\ntips = false\n"),
        # Shorter than a cell: no cover is parted by it, and no angle about its tips is continuous.
        ([[0.5, 0.0], [0.51, 0.004]], ""),
    ],
)
def test_tips_without_functions_are_told(crack: list[list[float]], table: str) -> None:
    how = parse_formulation(NET + table)
    (warning,) = run(parse_scene(cracked_plate(crack)), how).summary.warnings
    assert "crack tips without tip functions" in warning


def test_explain_says_which_tips_carry_functions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from nmm.cli.scene_verbs import explain

    scene = tmp_path / "plate.toml"
    formulation = tmp_path / "net.toml"
    formulation.write_text(NET)
    for crack, said in (
        ([[0.0, 0.0], [0.3, 0.1]], "crack tip [0.3, 0.1]: carries tip functions"),
        (kinked(np.pi / 2, 0.05), "crack tip [0.3, 0.05]: carries tip functions"),
    ):
        scene.write_text(cracked_plate(crack))
        explain(scene, formulation, False)
        assert said in capsys.readouterr().out
    formulation.write_text(NET + "[cover.enrichment]\ntips = false\n")
    explain(scene, formulation, False)
    assert "without tip functions" in " ".join(capsys.readouterr().out.split())


def test_functions_about_a_tip_are_found_once_for_the_covers_of_an_element_and_slope_as_they_rise(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    crack = [[[-0.5, 0.0], [0.5, 0.0]]]
    manifold = solid(
        SQUARE, CoverTable(type="triangles", size=0.4, degree=1), ROCK, "strain", cracks=crack
    ).manifold
    element = np.flatnonzero(np.hypot(*(manifold.elements.centroids - [0.5, 0.0]).T) < 0.2)
    point, step = manifold.elements.centroids[element], 1e-6
    unknowns = np.random.default_rng(3).normal(size=manifold.n_unknowns)
    asked: list[int] = []
    was = enriched_fields.singular_fields
    monkeypatch.setattr(
        enriched_fields, "singular_fields", lambda *a: asked.append(len(a[1])) or was(*a)
    )
    index, rows = manifold.gradient_rows(element, point)
    assert 0 < sum(asked) <= len(element)  # and not thrice, for three covers
    for axis in range(2):
        way = step * np.eye(2)[axis]
        ahead, behind = (
            manifold.rows(element, p).apply(unknowns) for p in (point + way, point - way)
        )
        slope = np.einsum("mcl,ml->mc", rows[:, :, axis], unknowns[index])
        # Truncation step^2 times third derivatives, of the root at distances above 0.05, 1e3.
        np.testing.assert_allclose(slope, (ahead - behind) / (2 * step), rtol=1e-5, atol=1e-6)


SQUARE = polygon([[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]])

ROCK = [Elastic(1.0, 0.3)]


def test_a_domain_that_holds_the_whole_of_its_crack_is_refused() -> None:
    cover = CoverTable.model_validate({"type": "triangles", "size": 0.1, "angle": 0.2})
    crack = [[[0.4, 0.0], [0.6, 0.0]]]
    model = solid(SQUARE, cover, [Elastic(1.0, 0.3)], "strain", cracks=crack)
    still = np.zeros(model.manifold.n_unknowns)
    assert stress_intensity(model, still, 0, 0.2, kappa=1.8).opening == 0.0
    with pytest.raises(NmmError, match="the crack reaches 0.2 m from it"):
        stress_intensity(model, still, 0, 0.3, kappa=1.8)


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
