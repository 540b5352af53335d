"""What a cover gets is by its properties: under another name every digit is the same."""

from itertools import product

import pytest

import nmm
from covers.mathematical.bspline import BSplines
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.testing.scenes import block_on_slab
from nmm.verification import text


class Hats(Triangles):
    """Triangles by another name."""


class Bilinear(Quads):
    """Quads by another name."""


class Smooth(BSplines):
    """B-splines by another name."""


class Discs(MovingLeastSquares):
    """Discs by another name."""


# A block that slides and rests on a slab of two glued materials: mortar contact under the exact
# enforcement, supports and volumes of patches all ask what cover there is.
SCENE = block_on_slab(0.45, [text.fixed_edge("below", ((0, 0), (2, 0)))])
NAMES = {"triangles": Hats, "quads": Bilinear, "bspline": Smooth, "mls": Discs}


def top(kind: str, supports: str) -> tuple[float, float]:
    degree = "functions = 'monomials'\ndegree = 1\n" if "mls" not in kind.lower() else ""
    text = f"[cover]\ntype = '{kind}'\nsize = 0.3\nangle = 0.3\n{degree}"
    text += f"[contact]\nenforcement = 'cone'\n[supports]\nmethod = '{supports}'\n"
    scene = parse_scene(SCENE, "scene")
    done = nmm.run(scene, parse_formulation(text), allow_code=[__name__])
    assert done.summary.status == "converged", done.summary.sentence
    return done.history["monitor:top:uy"][-1], done.history["reaction:below:y"][-1]


QUICK = {
    ("triangles", "nitsche"),
    ("quads", "lagrange"),
    ("bspline", "nitsche"),
    ("mls", "lagrange"),
}


@pytest.mark.parametrize(
    ("kind", "supports"),
    [
        pytest.param(*pair, marks=() if pair in QUICK else pytest.mark.slow)
        for pair in product(NAMES, ("nitsche", "lagrange"))
    ],
)
def test_a_cover_by_another_name_gives_the_same_digits(kind: str, supports: str) -> None:
    own = f"{__name__}:{NAMES[kind].__name__}"
    assert top(own, supports) == top(kind, supports)
