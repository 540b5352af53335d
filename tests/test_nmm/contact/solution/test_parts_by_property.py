"""Nothing hangs on names: parts defined here are treated as the built-in ones of their kind."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import nmm
from covers.mathematical.triangles import Triangles
from nmm.contact.enforcement.penalty import Penalty
from nmm.formulation import Formulation
from nmm.scene import parse_scene
from nmm.stepping.prepare import prepare
from nmm.verification import text

SCENE = text.scene(
    'plane = "strain"\nduration = 0.02\n[gravity]\n[inertia]\n[contact]\n',
    [
        text.material("rock", modulus=1e9, density=2500.0),
        text.interface("any", 30.0),
        text.box("base", (-1, -1), (3, 1)),
        text.box("top", (0, 0.001), (1, 0.999)),
        text.fixed_block("base"),
    ],
)
ME = Path(__file__).stem


@dataclass(frozen=True)
class OwnSprings(Penalty):
    """The penalty under another name."""

    name: ClassVar[str] = "own springs"


class OwnTriangles(Triangles):
    """Triangles under another name."""


@pytest.fixture(autouse=True)
def importable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, ME, sys.modules[__name__])


def found(contact: dict[str, object], cover: dict[str, object] | None = None) -> "nmm.Result":
    formulation = Formulation.model_validate({"contact": contact, "cover": cover or {}})
    return nmm.run(parse_scene(SCENE), formulation, allow_code=[ME])


def test_springs_of_ones_own_have_the_digits_of_the_penalty() -> None:
    """Energies too: an enforcement taken for exact by its name would store none in springs."""
    one, other = (found({"enforcement": name}) for name in ("penalty", f"{ME}:OwnSprings"))
    assert one.history["contact_energy"].max() > 0
    for name, column in one.history.items():
        if name.endswith(("energy", "penetration", "time")):
            np.testing.assert_array_equal(other.history[name], column, err_msg=name)


def test_passes_of_the_contact_table_reach_every_enforcement_that_counts_them() -> None:
    options = {"iteration": "open_close"}
    for name in ("penalty", f"{ME}:OwnSprings"):
        made = prepared({"enforcement": name, "max_passes": 3, "options": options})
        assert made.solver._enforcement.max_passes == 3


def prepared(contact: dict[str, object], cover: dict[str, object] | None = None):
    from nmm.trust import allowing

    formulation = Formulation.model_validate({"contact": contact, "cover": cover or {}})
    with allowing(ME):
        return prepare(parse_scene(SCENE), formulation).stepper.plan.contact


@pytest.mark.parametrize("degree", [0, 1, 2])
def test_a_net_of_ones_own_has_as_many_points_a_face_as_the_built_in_one(degree: int) -> None:
    """Hats of triangles are linear: their traces are of degree p + 1, whatever the class."""
    cover = {"functions": "monomials", "degree": degree, "size": 0.7}
    points = [
        prepared({}, {"type": kind, **cover}).partners._face_points
        for kind in ("triangles", f"{ME}:OwnTriangles")
    ]
    assert points == [(degree + 5) // 2] * 2
