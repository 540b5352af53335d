"""The manifold examples run and give what their texts say."""

import runpy
from pathlib import Path

import pytest

from nmm.formulation import read_formulation
from nmm.scene import read_scene
from nmm.stepping.run import run

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        (None, 23.73, 24.2),
        ("quadratic", 23.73, 24.2),
        ("finite_elements", 18.0, 24.0),
        ("meshless", 22.0, 25.0),
        ("dda", 0.0, 15.0),
    ],
)
def test_cooks_membrane_under_five_formulations(name: str | None, low: float, high: float) -> None:
    scene = read_scene(EXAMPLES / "cook" / "membrane.toml")
    chosen = None if name is None else read_formulation(EXAMPLES / "cook" / f"{name}.toml")
    found = run(scene, chosen)
    assert found.summary.status == "converged", found.summary.sentence
    assert low < found.history["monitor:middle:uy"][-1] < high


def test_intensity_of_the_edge_crack() -> None:
    main = runpy.run_path(str(EXAMPLES / "edge_crack" / "intensity.py"))["main"]
    factors = main()
    assert factors.opening == pytest.approx(3.54119, rel=2e-3)
    assert abs(factors.sliding) < 1e-3 * factors.opening


def test_a_cover_of_ones_own_takes_one_file() -> None:
    main = runpy.run_path(str(EXAMPLES / "own_cover" / "smooth_cover.py"))["main"]
    # Weights without linear precision: linear elements at best, measured 1.0 % low.
    assert main() == pytest.approx(23.968, rel=0.015)
