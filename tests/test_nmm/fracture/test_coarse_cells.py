"""Intensities where cells are of different sizes, or too coarse for what stands beside a tip."""

import numpy as np
import pytest

import nmm
from nmm.scene.read import parse_scene
from nmm.verification import text
from nmm.verification.problems.cracks.crack_scenes import crack, net

STILL = "[fracture]\ntoughness = 1e12\nincrement = 1.0\n"


def plate(cover: str, half: float = 1.0, hole: str = "", growth: str = "") -> str:
    """Return a square plate with a crack of one metre in its middle, under tension of one."""
    corners = text.rectangle((-half, -half), (half, half))
    top, bottom = ([[-half, y], [half, y]] for y in (half, -half))
    tables = [
        text.material("m", 1.0, 0.3, None),
        text.block("plate", "m", corners) + hole,
        crack("c", [[-0.5, 0.0], [0.5, 0.0]]),
        text.pulled_edge("up", top, [0.0, 1.0]),
        text.pulled_edge("down", bottom, [0.0, -1.0]),
        text.fixed_point("one", [-half, -half]),
        text.fixed_point("other", [half, -half], "y"),
        STILL + growth,
        cover,
    ]
    return text.scene('plane = "strain"', tables)


def graded(size: float, *foci: list[float]) -> str:
    """Return a cover that is fine about the foci."""
    options = f"options = {{ focus = {list(foci)}, radius = 0.1, growth = 0.15 }}\n"
    return f'[formulation.cover]\ntype = "graded"\nsize = {size}\n{options}'


@pytest.mark.parametrize("size", [0.01, 0.03])
def test_domains_are_of_the_cells_about_each_tip(size: float) -> None:
    """Fine at one tip alone: four of the finest cells are a fraction of one about the other."""
    run = nmm.run(parse_scene(plate(graded(size, [0.5, 0.0]))))
    found = [run.history[f"fracture:c:{end}:K_I"][-1] for end in ("start", "end")]
    # A11: finite elements on graded meshes. Coarse cells are a sixth of the crack.
    assert np.array(found) / (1.33371 * np.sqrt(np.pi * 0.5)) == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("growth", [0.15, 0.4, 0.8, 1.3])
def test_cells_that_grow_within_the_domain_of_a_tip_are_told_before_they_cost_a_percent(
    growth: float,
) -> None:
    cover = graded(0.05, [-0.5, 0.0], [0.5, 0.0]).replace("radius = 0.1, growth = 0.15", "GROWTH")
    run = nmm.run(parse_scene(plate(cover.replace("GROWTH", f"growth = {growth}"))))
    share = run.history["fracture:c:end:K_I"][-1] / (1.33371 * np.sqrt(np.pi * 0.5))  # A11
    told = any("domains of intensities hold few cells" in one for one in run.summary.warnings)
    assert told or abs(share - 1) < 0.005
    assert told == (growth > 0.5)


def test_discs_that_hold_too_little_material_leave_the_cells_their_widths() -> None:
    # Parts of cells that lost discs had none: "index 49 is out of bounds for axis 0 with size 49".
    cover = '[formulation.cover]\ntype = "mls"\nsize = 0.25\ndegree = 0\n'
    run = nmm.run(parse_scene(plate(cover)))
    share = run.history["fracture:c:end:K_I"][-1] / (1.33371 * np.sqrt(np.pi * 0.5))  # A11
    # Four cells along the crack.
    assert share == pytest.approx(1.0, abs=5e-3)


def holed(size: float, middle: tuple[float, float]) -> nmm.Run:
    """Return the plate of four metres with a hole of 0.1 m."""
    turn = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    ring = (np.array(middle) + 0.05 * np.stack([np.cos(turn), np.sin(turn)], axis=1)).tolist()
    scene = plate(net(size, 11.0), 2.0, f"holes = [{ring}]\n", "max_growth = 0.1\n")
    return nmm.run(parse_scene(scene))


def test_a_hole_as_small_as_a_cell_beside_a_tip_is_told() -> None:
    told = holed(0.1, (0.6, 0.0)).summary.warnings
    assert len(told) == 1
    assert "a hole of 0.1 m about [0.6, 0] lies in cells of 0.1 m" in told[0]
    assert not holed(0.1, (1.3, 0.0)).summary.warnings


def test_a_hole_of_three_cells_is_right_and_not_told() -> None:
    run = holed(0.032, (0.6, 0.0))
    assert not run.summary.warnings
    # 1.54606 on cells of 0.02, and of 0.02 about both tips in coarser ones.
    assert run.history["fracture:c:end:K_I"][-1] == pytest.approx(1.546, rel=0.01)


@pytest.mark.filterwarnings("error")
def test_a_hole_is_no_fault_where_no_crack_has_begun_that_may_grow_without_end() -> None:
    hole = "holes = [[[0.55, 0], [0.6, 0.05], [0.65, 0], [0.6, -0.05]]]\n"
    begins = "[fracture.nucleation]\ntensile_strength = 1e12\n"
    scene = plate(net(0.5, 11.0), 2.0, hole, begins).replace(
        crack("c", [[-0.5, 0.0], [0.5, 0.0]]), ""
    )
    assert not nmm.run(parse_scene(scene)).history["fracture:growth"].any()
