"""A scene without each of its effects, beside what mechanics says of the rest."""

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError
from nmm.formulation import Formulation
from nmm.model.called_for import CALLS
from nmm.study.ablation.ablate import Ablation, AblationRow, ablate
from nmm.study.ablation.omissions import TABLES, omissions
from nmm.study.ablation.page import (
    ablation_costs,
    ablation_rounding,
    ablation_table,
    ablation_verdict,
)
from nmm.study.cases import measure as measuring
from nmm.study.cases.variants import StudyCase
from nmm.verification import text

THROWN = text.scene(
    'plane = "stress"\nduration = 0.4\n[inertia]\n[gravity]\n',
    [
        text.material("a", 1e9, 0.0, 2000.0),
        text.box("b", (0, 0), (1, 1), "a"),
        '[[initial_velocities]]\nblock = "b"\nvelocity = [3, 0]',
        '[[loads]]\nname = "lift"\nkind = "body"\nblock = "b"\ndensity = [0, 2000]',
        '[[monitors]]\nname = "m"\npoint = [0.5, 0.5]',
    ],
)
T, G, LIFT = 0.4, 9.81, 1.0


@pytest.fixture(scope="module")
def thrown():
    scene = nmm.parse_scene(THROWN, "thrown.toml")
    return ablate(scene, Formulation.model_validate({"integrator": {"step": 0.01}}))


@pytest.mark.parametrize(
    ("without", "ux", "uy"),
    [
        ("gravity", 3 * T, LIFT * T**2 / 2),
        ("initial velocity", 0.0, (LIFT - G) * T**2 / 2),
        ("load lift", 3 * T, -G * T**2 / 2),
        ("finite rotation", 3 * T, (LIFT - G) * T**2 / 2),
    ],
)
def test_what_is_left_moves_as_free_flight_says(thrown, without, ux, uy):
    row = next(row for row in thrown.rows if row.name == without)
    # Constant acceleration is exact in every step; a stiff block swings by its load over E.
    np.testing.assert_allclose(row.values, [ux, uy], atol=1e-6)


def test_changes_are_shares_of_the_motion_as_a_whole(thrown):
    row = next(row for row in thrown.rows if row.name == "gravity")
    fallen = G * T**2 / 2
    np.testing.assert_allclose(thrown.changes(row), [0.0, fallen / (3 * T)], atol=1e-6)


def test_a_free_body_has_no_rest_without_inertia_and_the_other_rows_go_on(thrown):
    row = next(row for row in thrown.rows if row.name == "inertia")
    assert row.verdict == "collapsed"
    assert len(thrown.rows) == 5


def test_what_cannot_be_left_out_alone_is_told_and_the_rest_goes_on():
    cracked = "\n[contact]\n[interfaces.any]\nfriction_angle = 0.0\nbonded = true\n"
    cracked += "tensile_strength = 1e6\ncohesion = 1e6\n"
    cracked += '[[cracks]]\nname = "c"\npoints = [[0, 0.5], [1, 0.5]]\nbonded = true\n'
    method = {"cover": {"type": "triangles", "size": 0.6}, "integrator": {"step": 0.1}}
    found = ablate(nmm.parse_scene(THROWN + cracked), Formulation.model_validate(method))
    row = next(row for row in found.rows if row.name == "contact")
    assert row.verdict.startswith("cannot be left out alone")
    assert "crack" in row.verdict
    assert [one.verdict for one in found.rows].count("converged") >= 3


def test_contact_is_left_out_of_a_scene_that_stores_what_happens_to_it():
    stored = '\n[contact]\n[output]\nevents = ["first_contact"]\n'
    stored += "[interfaces.any]\nfriction_angle = 0.0\n"
    short = {"integrator": {"step": 0.1}}
    found = ablate(nmm.parse_scene(THROWN + stored), Formulation.model_validate(short))
    row = next(row for row in found.rows if row.name == "contact")
    np.testing.assert_allclose(row.values, [3 * T, (LIFT - G) * T**2 / 2], atol=1e-6)


SWAYING = text.scene(
    'plane = "stress"\nduration = 0.02\n[inertia]\n[damping]\nmass = 1.0\n',
    [
        text.material("a", 1e6, 0.0, 2000.0),
        text.box("b", (0, 0), (1, 1), "a"),
        "[records.quake]\nsamples = [[0, 0], [0.01, 1]]\n",
        text.fixed_edge("base", [(0, 0), (1, 0)]) + 'motion = { x = "quake" }\n',
        '[[dashpots]]\nname = "d"\npoints = [[1, 1], [2, 1]]\n'
        'blocks = ["b", "ground"]\nviscosity = 1e3\n',
        '[[initial_velocities]]\nblock = "b"\nvelocity = [0.1, 0]',
        '[[loads]]\nname = "down"\nkind = "edge"\nsegment = [[0, 1], [1, 1]]\ntraction = [0, -1e3]',
        '[[monitors]]\nname = "m"\npoint = [0.5, 1]',
    ],
)


def test_what_needs_inertia_goes_with_it_and_the_rest_stands_under_its_loads():
    found = ablate(nmm.parse_scene(SWAYING), Formulation())
    row = next(row for row in found.rows if row.name == "inertia")
    # A column of 1 m under 1 kPa; its foot on springs of a thousand moduli.
    np.testing.assert_allclose(row.values, [0.0, -1e-3], atol=2e-6)


def test_every_effect_of_the_scene_has_a_line_of_the_table(thrown):
    lines = ablation_table(thrown)
    assert len(lines) == 2 + 1 + len(thrown.rows)
    assert lines[2].endswith("| converged |")  # the whole scene
    widths = {line.count("|") for line in lines}
    assert widths == {2 + 1 + 2 + 3 - 1}


def test_the_verdict_names_what_matters_most_first(thrown):
    """Without velocity, gravity and lift 1.2, 0.785 and 0.08 m of 1.2 m are missing."""
    wanted = "initial velocity (100 %), gravity (65.4 %), load lift (6.67 %)"
    falls = "matters: inertia (collapsed without)"
    assert ablation_verdict(thrown) == f"{falls}, {wanted}; below 0.1 %: finite rotation"


def test_free_fields_go_with_the_viscous_boundary_that_is_their_base():
    tables = {
        "viscous_boundaries": [{"name": "base"}],
        "free_fields": [{"name": "side", "base": "base"}],
        "inertia": {},
    }
    left = {one.name: set(one.scene) for one in omissions(tables, {})}
    assert left["viscous boundaries"] == {"inertia"}
    assert left["free fields"] == {"inertia", "viscous_boundaries"}


@pytest.mark.parametrize(
    ("whole", "without", "cell"),
    [
        ((3e-16, 1e-15), (-8e-16, 2e-16), "0"),  # a change of 370 %, of nothing
        ((3e-16, 1e-15), (2e-3, 0.0), "from 0"),
        ((3e-16, -4e-3), (5e-16, -2e-3), "0"),  # 5e-14 of the motion
        ((2e-6, -4e-3), (3e-6, -4e-3), "+0.025 %"),
    ],
)
def test_shares_of_rounding_are_shown_as_nothing(whole, without, cell):
    """Coordinates of 4 m are rounded by 9e-16 m, displacements of solutions by some thousands."""
    rows = (AblationRow("friction", without, 1.0, "converged"),)
    first = AblationRow("the whole scene", whole, 1.0, "converged")
    found = Ablation(("monitor:m:ux", "monitor:m:uy"), first, rows, 4.0)
    assert ablation_table(found)[3].split(" | ")[1] == cell
    told = abs(whole[0]) < 4e-12
    assert ablation_table(found)[2].split(" | ")[1] == ("0" if told else f"{whole[0]:.6g}")
    assert ("monitor:m:ux (below 4e-12)" in ablation_rounding(found)) == told
    assert ("from nothing" in ablation_verdict(found)) == (cell == "from 0")


def test_what_takes_long_is_told_of_runs_that_end_alike():
    """Of 4 s contact takes 3 and heat 1; what falls at once without gravity is no saving."""
    rows = [("heat", 3.0), ("contact", 1.0), ("gravity", 0.1), ("friction", 3.9)]
    ends = {"gravity": "collapsed"}
    found = Ablation(
        ("energy",),
        AblationRow("the whole scene", (1.0,), 4.0, "converged"),
        tuple(AblationRow(name, (1.0,), s, ends.get(name, "converged")) for name, s in rows),
    )
    wanted = "contact (75 % of the seconds), heat (25 % of the seconds)"
    assert ablation_costs(found) == f"takes long: {wanted}"


def test_the_verdict_names_first_what_the_scene_collapses_without():
    """A block of 20 kN that 5 kN push along a floor stays: it has weight, a floor, and friction."""
    scene = text.scene(
        'plane = "stress"\n[gravity]\n[contact]\n[interfaces.dry]\nfriction_angle = "30 deg"\n',
        [
            text.material("a", 1e9, 0.0, 2000.0),
            text.box("floor", (-1, -1), (3, 1), "a"),
            text.box("b", (0, 0), (1, 1), "a"),
            '[[supports]]\nname = "s"\nblock = "floor"\nfix = ["x", "y"]',
            '[[loads]]\nname = "push"\nkind = "body"\nblock = "b"\ndensity = [5e3, 0]',
            '[[monitors]]\nname = "m"\npoint = [0.5, 0.5]',
        ],
    )
    said = ablation_verdict(ablate(nmm.parse_scene(scene), Formulation()))
    needed = [name for name in said.split(", ") if "collapsed without" in name]
    wanted = ["gravity", "contact", "friction"]
    assert said.startswith("matters: " + ", ".join(f"{n} (collapsed without)" for n in wanted))
    assert len(needed) == len(wanted)


def test_of_two_effects_of_one_table_that_of_the_scene_alone_is_left_out():
    scene = text.scene(
        'plane = "strain"\n[seepage]\n',
        [
            text.material("a", 1e9, 0.0, None) + "hydraulic_conductivity = 1e-6\n",
            text.box("b", (0, 0), (1, 1), "a"),
            '[[heads]]\nname = "h"\nsegment = [[0, 0], [1, 0]]\nhead = 1.0',
            '[[supports]]\nname = "s"\nsegment = [[0, 0], [1, 0]]\nfix = ["x", "y"]',
        ],
    )
    names = [row.name for row in ablate(nmm.parse_scene(scene), Formulation()).rows]
    assert "seepage" in names
    assert "consolidation" not in names


@pytest.mark.parametrize(("long", "runs"), [(0.0, 1 + 1 + 1), (np.inf, 2 + 2)])
def test_first_runs_that_are_long_are_not_made_again(long, runs, monkeypatch):
    made, once = [], measuring._once
    monkeypatch.setattr(measuring, "_once", lambda *given: made.append(0) or once(*given))
    case = StudyCase("thrown", nmm.parse_scene(THROWN), Formulation())
    found = measuring.measure([case, case], (), 1, memory=False, long=long)
    assert len(made) == runs
    assert [len(one.seconds) for one in found] == [1, 1]


def test_a_quantity_that_no_run_has_is_refused_before_any_is_made():
    scene = nmm.parse_scene(THROWN, "thrown.toml")
    with pytest.raises(NmmError, match="wrong"):
        ablate(scene, Formulation(), ["wrong"])


def test_every_effect_can_be_left_out_or_is_known_to_be_left_out_by_its_loads_or_kept():
    by_load = {"loads", "body loads", "field loads", "pressures", "moving loads"}
    as_damping = {"viscous damping", "damping against the ground", "local damping"}
    kept = {"supports", "bonded interfaces"}  # without them nothing is left of a structure
    within_tables = {"dowels", "unreleased forces", "changed materials"}
    assert set(CALLS) - set(TABLES) == by_load | as_damping | kept | within_tables


def test_forces_that_a_stage_holds_back_are_released_and_the_stages_stay():
    stages = [{"name": "dig", "release": 0.5}, {"name": "line"}]
    found = {one.name: one.scene for one in omissions({"stages": stages}, {})}
    assert found["unreleased forces"]["stages"] == [{"name": "dig"}, {"name": "line"}]
    assert "release" in stages[0]


def test_materials_that_a_stage_changes_stay_and_so_does_the_stage():
    stages = [{"name": "in place"}, {"name": "wet", "materials": {"slope": "weathered"}}]
    found = {one.name: one.scene for one in omissions({"stages": stages}, {})}
    assert found["changed materials"]["stages"] == [{"name": "in place"}, {"name": "wet"}]


def test_dowels_are_left_out_and_their_bars_stay():
    bars = [{"name": "a", "dowel": {"bedding_stiffness": 5e7}}, {"name": "b"}]
    found = {one.name: one.scene for one in omissions({"bars": bars}, {})}
    assert found["dowels"]["bars"] == [{"name": "a"}, {"name": "b"}]
    assert "dowel" in bars[0]
    assert found["bars"] == {}


@pytest.mark.parametrize(
    ("left", "key", "entries"),
    [
        ("bars", "members", {"bars": [{"name": "bolt"}], "springs": [{"name": "prop"}]}),
        ("load wheel", "loads", {"loads": [{"name": "wheel"}, {"name": "wind"}]}),
        (
            "water pressures",
            "water",
            {"water_pressures": [{"name": "lake"}], "seepage": {}, "heads": [{"name": "well"}]},
        ),
    ],
)
def test_stages_no_longer_name_what_is_left_out(left, key, entries):
    names = [one["name"] for table in entries.values() for one in table]
    stages = [{"name": "in place", key: []}, {"name": "all", key: names}, {"name": "on"}]
    found = {one.name: one.scene for one in omissions({**entries, "stages": stages}, {})}
    assert found[left]["stages"] == [stages[0], {"name": "all", key: names[1:]}, stages[2]]
    assert stages[1][key] == names


def test_loads_that_are_left_out_are_not_scaled():
    tables = {"loads": [{"name": "a"}, {"name": "b"}], "loading": {"scaled": ["a", "b"]}}
    found = {one.name: one.scene for one in omissions(tables, {})}
    assert found["load a"]["loading"] == {"scaled": ["b"]}


SOIL = {
    "law": "mohr_coulomb",
    "young_modulus": 1e8,
    "poisson_ratio": 0.3,
    "cohesion": 1e4,
    "friction_angle": 0.5,
    "softening_energy": 100.0,
    "residual_friction_angle": 0.3,
    "hydraulic_conductivity_2": 1e-6,
    "axis_angle": 0.2,
}


def test_matter_keeps_its_strength_or_is_elastic_and_conducts_as_before():
    found = {one.name: one.scene for one in omissions({"materials": {"soil": SOIL}}, {})}
    lasting = {k: v for k, v in SOIL.items() if not k.startswith(("softening", "residual"))}
    assert found["softening of matter"]["materials"]["soil"] == lasting
    kept = ("young_modulus", "poisson_ratio", "hydraulic_conductivity_2", "axis_angle")
    assert found["yield"]["materials"]["soil"] == {key: SOIL[key] for key in kept}
    assert "creep" not in found
    assert "softening_energy" in SOIL


def test_what_is_asked_for_is_compared_without_being_named():
    """``tan 40 / tan 30`` of a block on a joint, and without gravity nothing to reduce."""
    scene = nmm.read_scene("examples/slope_strength_reduction/block.toml")
    found = ablate(scene, Formulation())
    assert found.quantities == ("factor_of_safety",)
    wanted = np.tan(np.radians(40)) / np.tan(np.radians(30))
    assert found.whole.values[0] == pytest.approx(wanted, rel=0.011)
