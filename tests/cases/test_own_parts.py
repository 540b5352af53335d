"""Parts of a user's own: a mathematical cover, an interface law, a material law: one file each."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import nmm
from covers.cutting.cut import cut
from integration.polygons import Polygons
from nmm.testing import check_law

EXAMPLES = Path(__file__).parents[2] / "examples"


Script = Callable[[Path], ModuleType]


@pytest.fixture
def beside(monkeypatch: pytest.MonkeyPatch) -> None:
    for folder in ("own_cover", "own_law"):
        monkeypatch.syspath_prepend(str(EXAMPLES / folder))


@pytest.mark.usefixtures("beside")
def test_a_net_of_ones_own_gives_the_cylinder_under_pressure(script: Script) -> None:
    found = script(EXAMPLES / "own_cover" / "cylinder.py").main()
    for error, _ in found.values():
        # Benchmark A6 asks for 0.5 % with linear covers.
        assert abs(error) < 0.005
    # Cells as small at the bore, fewer elsewhere.
    assert found["radial"][1] < 0.6 * found["triangles"][1]


@pytest.mark.usefixtures("beside")
@pytest.mark.parametrize("size", [0.1, 0.5])
def test_the_net_of_ones_own_reaches_around_any_box(script: Script, size: float) -> None:
    cover = script(EXAMPLES / "own_cover" / "radial.py").Radial
    box = np.array([[-3.0, -1.0], [2.0, 5.0]])
    low, high = box
    laid = cover.regular(box, size, centre=(0.0, 0.5), inner=0.4)
    outline = [low, [high[0], low[1]], high, [low[0], high[1]]]
    turn = np.linspace(0, -2 * np.pi, 64, endpoint=False)
    hole = 0.45 * np.stack([np.cos(turn), np.sin(turn)], axis=1) + [0.0, 0.5]
    pieces = cut(laid, Polygons.from_rings([[np.array(outline), hole]]))
    # The cut itself refuses covers that leave material uncovered.
    assert pieces.elements.areas.sum() == pytest.approx(
        30 - 32 * np.sin(np.pi / 32) * 0.45**2, rel=1e-12
    )


@pytest.mark.usefixtures("beside")
def test_a_law_of_ones_own_breaks_the_glue_on_its_ellipse() -> None:
    scene = nmm.read_scene(EXAMPLES / "own_law" / "scarf.toml")
    done = nmm.run(scene, allow_code=["elliptic"])
    assert done.summary.status == "failure_load"
    # 1 MPa at factor 1; the bracket is 0.5 % wide.
    assert done.summary.failure_factor == pytest.approx(2 / np.hypot(1 / 3, 1 / 4), rel=0.005)


@pytest.mark.usefixtures("beside")
def test_a_material_law_of_ones_own_remembers_and_creeps() -> None:
    done = nmm.run(nmm.read_scene(EXAMPLES / "own_law" / "creep.toml"), allow_code=["maxwell"])
    assert done.summary.status == "converged"
    history = done.history
    shorter = history["monitor:base:uy"] - history["monitor:top:uy"]
    # sigma/4 [1/G + t/eta + 3 (1/3K + (1/(3K+G) - 1/3K) exp(-3Kt / tau(3K+G)))], checked by the
    # inverse Laplace transform; backward Euler with tau / 100 is off by less than 1e-3.
    for time, strain in ((1e3, 9.442686692e-5), (1e4, 1.004997224e-4), (1e5, 1.597837612e-4)):
        at = int(np.argmin(np.abs(history["time"] - time)))
        assert shorter[at] == pytest.approx(strain, rel=1e-3)


@pytest.mark.usefixtures("beside")
def test_the_law_of_the_example_keeps_what_every_law_must(script: Script) -> None:
    law = script(EXAMPLES / "own_law" / "maxwell.py").Maxwell(10e9, 0.25, 4e14)
    check_law(law, planes=("strain",), step=1e4)


@pytest.mark.usefixtures("beside")
def test_a_variable_of_ones_own_that_is_no_array_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "scalar.py").write_text(
        "from maxwell import Maxwell\n\n\nclass Scalar(Maxwell):\n"
        "    def variables(self, plane):\n        return {'age': 0.0}\n"
    )
    text = (
        (EXAMPLES / "own_law" / "creep.toml")
        .read_text()
        .replace("maxwell:Maxwell", "scalar:Scalar")
    )
    with pytest.raises(
        nmm.NmmError, match=r'Scalar: variable "age": shape \(\): expected an array'
    ):
        nmm.run(nmm.parse_scene(text), allow_code=["scalar"])
    from scalar import Scalar  # type: ignore[import-not-found]

    with pytest.raises(AssertionError, match=r"variables: age of shape \(\)"):
        check_law(Scalar(10e9, 0.25, 4e14), planes=("strain",))
