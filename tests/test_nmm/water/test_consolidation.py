"""Seepage and strain both ways: what is undrained, what settles, and what is refused."""

from itertools import pairwise

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError
from nmm.verification import text as scene_text
from nmm.verification.problems.water.consolidation import (
    CONFINED,
    HEIGHT,
    LOAD,
    WEIGHT,
    ConsolidatingColumn,
    isochrone,
    settled,
)
from nmm.verification.problems.water.seepage import pressure

QUADS = '[formulation.cover]\ntype = "quads"\nsize = 1.0\ndegree = 1\n'
DEEP = np.array([[0.5, 0.1 * HEIGHT], [0.5, 0.6 * HEIGHT]])


def column(change=("", ""), **given):
    """Run a column on quads with a change of its text."""
    text = ConsolidatingColumn(**given).scene() + QUADS
    return nmm.run(nmm.parse_scene(text.replace(*change), "scene"))


@pytest.mark.parametrize("storage", [1e-3, 0.5])
def test_water_that_has_no_time_to_leave_carries_its_share_of_the_load(storage):
    """``p = q / (1 + S M / w)``, and the soil gives way by what the water is compressed."""
    run = column(steps=2, storage=storage, time=1e-7)
    assert pressure(run, DEEP) == pytest.approx(LOAD / (1 + storage), rel=1e-3)
    down = LOAD * HEIGHT / CONFINED * storage / (1 + storage)
    assert -run.history["monitor:top:uy"][-1] == pytest.approx(down, rel=0.02)


@pytest.mark.parametrize(
    "cover", [QUADS, QUADS.replace("quads", "triangles").replace("1.0", "0.7")]
)
def test_water_a_million_times_as_stiff_as_soil_spoils_no_digits(cover):
    """``p = q / (1 + S M / w)``, and a settlement of 1e-6 of the drained one."""
    storage, free = 1e-6, LOAD * HEIGHT / CONFINED
    text = ConsolidatingColumn(steps=2, storage=storage, time=1e-12).scene()
    run = nmm.run(nmm.parse_scene(text + cover, "scene"))
    assert run.summary.status == "converged"
    # What flows in this time is a share of sqrt(1e-12) of a cell; solutions end at 1e-10 of the
    # forces, a millionth of which strains the soil.
    assert pressure(run, DEEP) == pytest.approx(LOAD, rel=3e-6)
    down = -run.history["monitor:top:uy"][-1]
    assert down == pytest.approx(free * storage / (1 + storage), rel=1e-3)


@pytest.mark.parametrize("tops", [(5.0,), (1.3, 2.0, 3.7, 5.0)])
def test_blocks_that_nitsches_terms_glue_and_support_follow_the_series(tops):
    """The pressure is a part of the traction, and what the terms leave open makes room for water.

    With either alone columns settled by 5 % too much.
    """
    case = ConsolidatingColumn(steps=160)
    text = case.scene().replace('method = "lagrange"', 'method = "nitsche"')
    whole, after = text.index("[[blocks]]"), text.index("[[heads]]")
    text = text[:whole] + glued(tops) + text[after:] + QUADS.replace("1.0", "0.4")
    run = nmm.run(nmm.parse_scene(text, "scene"))
    assert run.summary.status == "converged"
    assert {name: check for name, check in case.measure(run).items() if not check.passed} == {}


def glued(tops):
    """Return the column as glued blocks that end at ``tops``, the uppermost named as the whole."""
    names = [f"layer {i}" for i in range(len(tops) - 1)] + ["soil"]
    corners = [((0, low), (1, top)) for low, top in pairwise((0.0, *tops))]
    parts = [
        scene_text.block(name, "soil", scene_text.rectangle(*ends))
        for name, ends in zip(names, corners, strict=True)
    ]
    face = scene_text.interface("face", 30.0, None, {"bonded": True}) + 'leakage = "perfect"\n'
    return face + "".join(parts)


def test_errors_fall_with_the_step_in_order_one():
    exact = LOAD * HEIGHT / CONFINED * (1e-3 + settled(0.3)) / 1.001
    off = [abs(column(steps=n).history["monitor:top:uy"][-1] + exact) for n in (10, 20, 40)]
    assert np.log2(off[0] / off[1]) == pytest.approx(1.0, abs=0.1)
    assert np.log2(off[1] / off[2]) == pytest.approx(1.0, abs=0.1)


def test_in_the_end_water_carries_nothing():
    run = column(steps=20, time=8.0)
    assert abs(pressure(run, DEEP)).max() < 1e-3 * LOAD
    assert -run.history["monitor:top:uy"][-1] == pytest.approx(LOAD * HEIGHT / CONFINED, rel=1e-3)


def test_water_that_leaves_is_what_the_soil_settles_by():
    run = column(steps=20)
    out = -run.history["consolidation:taken:top"][-1]
    settled_by = -run.history["monitor:top:uy"][-1]
    # What is compressed holds 1e-3 of it.
    assert out == pytest.approx(settled_by, rel=2e-3)


def test_an_uncoupled_column_settles_as_if_nothing_flowed():
    """Without coupling pores feel no load: all of the settlement comes at once."""
    run = column(("coupled = true\n", ""), steps=4)
    assert -run.history["monitor:top:uy"][0] == pytest.approx(LOAD * HEIGHT / CONFINED, rel=1e-3)
    assert abs(pressure(run, DEEP)).max() < 1e-3 * LOAD


def test_a_column_with_inertia_follows_the_series_under_a_slow_load():
    """A load that grows over the time is the mean of sudden ones (Olson 1977)."""
    text = ConsolidatingColumn(steps=1).scene() + QUADS
    text = text.replace("[loading]\nscaled = []\n", "duration = 0.3\n[inertia]\n")
    text = text.replace("duration = 0.3\n[formulation.loading]\nincrement = 1.0\n", "")
    text = text.replace("[materials.soil]\n", "[materials.soil]\ndensity = 1e-3\n")
    text = text.replace('name = "fill"\n', 'name = "fill"\nhistory = [[0, 0], [0.3, 1]]\n')
    integrator = '[formulation.integrator]\ntype = "shi"\nstep = 0.005\n'
    run = nmm.run(nmm.parse_scene(text + integrator, "scene"))
    depth, ages = 1 - DEEP[:, 1] / HEIGHT, (np.arange(60) + 0.5) / 60 * 0.3
    exact = np.mean([isochrone(depth, age) for age in ages], axis=0)
    assert pressure(run, DEEP) / LOAD == pytest.approx(exact, abs=0.01)


def test_a_weighty_water_gives_the_same_excess():
    """Weight changes heads, not what the soil does, where flow and storage are the same."""
    light = column(steps=8).history["monitor:top:uy"]
    text = ConsolidatingColumn(steps=8).scene() + QUADS
    storage, conductivity = 1e-3 * WEIGHT / CONFINED, HEIGHT**2 * 1.001 * WEIGHT / CONFINED
    text = text.replace(f"unit_weight = {WEIGHT!r}", f"unit_weight = {2 * WEIGHT!r}")
    text = text.replace(f"= {conductivity!r}", f"= {2 * conductivity!r}")
    text = text.replace(f"= {storage!r}", f"= {2 * storage!r}")
    heavy = nmm.run(nmm.parse_scene(text, "scene")).history["monitor:top:uy"]
    assert heavy == pytest.approx(light, rel=1e-4)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("transient = true\n", ""), "transient = true"),
        (('update = "small"', 'update = "finite"'), "a body that bends by any angle"),
        (
            (
                "[formulation.supports]",
                "[formulation.diffusion]\ntheta = 0.5\n[formulation.supports]",
            ),
            "theta = 1",
        ),
    ],
)
def test_what_cannot_be_solved_together_is_refused_by_line(change, said):
    with pytest.raises(NmmError, match="scene:") as caught:
        column(change)
    assert said in str(caught.value)
