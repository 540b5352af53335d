"""What a cost study may conclude: its reference, the orders of theory, where it ran from."""

import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

import nmm
from covers.mathematical.triangles import Triangles
from nmm.errors import NmmError
from nmm.geometry.tessellation.block_cover import BlockCover
from nmm.plots.families import METHODS, styles
from nmm.study.cases.measure import record
from nmm.study.cases.record import Record
from nmm.study.cases.variants import SIZE, StudyCase
from nmm.study.cost.cost_study import CostStudy, cost_study
from nmm.study.cost.front import LEVELS, levels_of
from nmm.study.cost.levels import levels
from nmm.study.cost.reference import Reference
from nmm.study.cost.report import cost_page
from nmm.study.cost.theory import order_in_size
from nmm.trust import allowing

REFERENCE = """
[[reference]]
quantity = "external_work"
value = 2e-6
tolerance = 0.1
source = "s^2 L / (2 E)"
"""
ME = Path(__file__).stem
DDA = {"DDA": nmm.Formulation()}


def made(name, cover, unknowns, value, seconds, family="manifold", spanned=None, **settings):
    return Record(
        name,
        settings,
        "k",
        "converged",
        "why",
        {"external_work": value},
        (seconds,),
        (seconds,),
        unknowns=unknowns,
        cover=cover.split(" ")[0],
        family=family,
        spanned=spanned,
        method={"cover": cover, "enforcement": "penalty", "integrator": "shi"},
    )


def test_a_varied_scene_is_refused_as_its_answer_varies_too(bar_text):
    bar = nmm.parse_scene(bar_text(more=REFERENCE))
    with pytest.raises(NmmError, match=r"--vary materials\.m\.young_modulus: changes the scene"):
        cost_study(bar, DDA, {"materials.m.young_modulus": [1.0, 2.0]}, memory=False)


def test_a_scene_divided_ever_finer_is_measured_against_an_extrapolated_value():
    text = (Path(__file__).parents[4] / "examples/kitoh_beam/kitoh_130.toml").read_text()
    text = text.replace('until = "failure"', "until = 1.0").replace("maximum_factor = 40\n", "")
    text = text.replace('quantity = "failure_factor"', 'quantity = "external_work"')
    scene = nmm.parse_scene(text)
    study = cost_study(scene, DDA, {"tessellations.0.blocks": [4, 8]}, repeats=1, memory=False)
    assert study.reference.extrapolated
    assert study.reference.quantity == "external_work"


class Mine(Triangles):
    """Triangles under another name."""


@dataclass(frozen=True)
class Stones(BlockCover):
    """Whole blocks under another name."""


@pytest.mark.parametrize(
    ("cover", "family", "degree"),
    [
        ({"type": "triangles", "degree": 0}, "manifold", 1),
        ({"type": "quads", "degree": 2}, "manifold", 3),
        ({"type": "mls", "degree": 0}, "manifold", 1),
        ({"type": "mls", "degree": 1, "options": {"degree": 0}}, "manifold", 1),
        ({"type": "bspline", "degree": 0}, "manifold", 2),
        ({"type": f"{ME}:Mine", "degree": 1}, "manifold", 2),
        ({"type": "sub_blocks"}, "DDA", 1),
        ({"type": "block"}, "DDA", None),
        ({"type": f"{ME}:Stones"}, "DDA", None),
    ],
)
def test_weights_add_the_degree_that_they_reproduce_to_that_of_their_functions(
    bar_text, monkeypatch, cover, family, degree
):
    # Hats and moving least squares reproduce linear fields, Shepard's constants, splines their own.
    monkeypatch.setitem(sys.modules, ME, sys.modules[__name__])
    size = {} if degree is None else {"size": 0.5}
    formulation = nmm.Formulation.model_validate({"cover": cover | size})
    with allowing(ME):
        found = record(StudyCase("a", nmm.parse_scene(bar_text()), formulation), ["energy"])
    assert (found.status, found.family, found.spanned) == ("converged", family, degree)


def test_an_energy_falls_twice_as_fast_as_its_norm():
    assert order_in_size(2, "external_work") == (4.0, "2 (s + p)")
    assert order_in_size(2, "monitor:tip:uy") == (3.0, "s + p + 1")
    assert order_in_size(2, "failure_load") is None


def test_observed_orders_stand_beside_those_of_theory():
    records = [
        made("T1", "triangles 1", n, 1 + 5 * n**-2.0, 1.0, spanned=2) for n in (10, 40, 90, 160)
    ]
    page = cost_page(CostStudy("", records, Reference("external_work", 1.0, 0, "exact")), "a.png")
    assert "T1: 4.00 +- 0.00 (4 points) in unknowns^(-1/2); theory 4 = 2 (s + p)" in page


@pytest.mark.parametrize(
    ("off", "said"),
    [
        # unknowns 2 (n + 1)^2 on a square would give an order of 2.39
        (lambda n: n**-2.0, "2.00 +- 0.00 (4 points) in formulation.cover.size; theory 2"),
        (lambda n: 2e-16 * n, "no order, its errors are rounding"),
    ],
)
def test_orders_are_those_in_the_size_of_covers_and_of_errors_above_rounding(off, said):
    records = [
        made("Q0", "quads 0", 2 * (n + 1) ** 2, 1 + off(n), 1.0, spanned=1, **{SIZE: 1 / n})
        for n in (2, 4, 8, 16)
    ]
    page = cost_page(CostStudy("", records, Reference("external_work", 1.0, 0, "exact")), "a.png")
    assert f"- Q0: {said}" in page


def test_the_cheapest_of_each_family_are_compared_at_equal_error():
    records = [
        made("DDA", "block 1", 6, 1.5, 1.0, "DDA"),
        *(made("T0", "triangles 0", n, 1 + 1 / n, n / 10) for n in (10, 1000)),
        *(made("T1", "triangles 1", n, 1 + 1 / n, n / 20) for n in (10, 1000)),
        *(made("P1", "skfem 1", n, 1 + 1 / n, n / 80, "elements") for n in (10, 1000)),
    ]
    study = CostStudy("", records, Reference("external_work", 1.0, 0, "exact"))
    found = [line for line in levels(study) if line.startswith("- at error 0.01,")]
    # error 1/100 at n = 100: 100/80 s by the elements, four times that by T1, eight by T0
    assert found == ["- at error 0.01, P1 costs 1.25 s; T1 costs 4 times that; not reached by DDA"]


def test_levels_lie_among_errors_however_small():
    assert levels_of([0.3, 1e-4, float("nan")]) == LEVELS
    assert levels_of([7e-7, 3e-9, 0.0]) == (1e-7, 1e-8)
    many = levels_of([7e-7, 3e-16])
    assert len(many) <= 6
    assert many[0] == 1e-7
    assert min(many) > 3e-16


def test_a_method_has_one_look_whatever_stands_beside_it():
    few = styles(["manifold"], ["quads 1"])
    many = styles(["DDA", "manifold", "manifold"], ["block 1", "triangles 1", "quads 1"])
    assert few[0] == many[2] == METHODS["quads 1"]
    assert len({look for look in METHODS.values() if look[0] != "#1d4e89"}) > 15
    twice = styles(["DDA", "DDA"], ["block 1", "block 1"])
    assert twice[0] != twice[1]
