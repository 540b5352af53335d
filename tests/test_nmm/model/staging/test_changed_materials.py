"""Blocks whose material a stage changes keep their stress and answer by the new law from there."""

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError, SceneError
from nmm.testing.resumed.stopping import check_goes_on

BAR = """
plane = "stress"
{head}
[materials.first]
{first}
poisson_ratio = 0.0
density = 2000
[materials.second]
{second}
poisson_ratio = 0.0
density = 2000
[[blocks]]
name = "bar"
material = "first"
vertices = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[supports]]
name = "wall"
segment = [[0, 0], [0, 1]]
fix = ["x"]
[[supports]]
name = "pin"
point = [0, 0.5]
fix = ["y"]
[[monitors]]
name = "end"
point = [4, 0.5]
{more}
[formulation.cover]
{cover}
[formulation.supports]
method = "{held}"
[formulation.loading]
increment = 0.25
"""
LOADS = "".join(
    f"""
[[loads]]
name = "{name}"
kind = "edge"
segment = [[4, 0], [4, 1]]
traction = [{pull}, 0]
"""
    for name, pull in (("one", 4e3), ("two", 3e3))
)
STAGES = """
[[stages]]
name = "pulled"
loads = ["one"]
[[stages]]
name = "other"
materials = { bar = "second" }
{cover}
[[stages]]
name = "on"
loads = ["one", "two"]
[[stages]]
name = "let go"
loads = []
"""
E1, E2, YIELD, HARD = 2e6, 0.5e6, 5e3, 1e5
ELASTIC = {"first": f"young_modulus = {E1}", "second": f"young_modulus = {E2}"}
FLOWS = f'law = "von_mises"\nyield_stress = {YIELD}\nhardening_modulus = {HARD}\n'
COVERS = {
    "block": 'type = "block"',
    "quads": 'type = "quads"\nsize = 1.0\ndegree = 1',
    "quadratic triangles": 'type = "triangles"\nsize = 1.0\ndegree = 2',
    "splines": 'type = "bspline"\nsize = 0.8\ndegree = 2',
}


def bar(first, second, cover="quads", change="", more="", head=""):
    stages = STAGES.replace("{cover}", change)
    held = "auto" if cover == "block" else "lagrange"
    more = LOADS + stages + more
    text = BAR.format(
        first=first, second=second, cover=COVERS[cover], more=more, head=head, held=held
    )
    return nmm.parse_scene(text)


def ends(run):
    """Ways of the end of the bar where each of the four stages has come to rest."""
    assert run.summary.status == "converged", run.summary.sentence
    at = np.flatnonzero(np.isclose(run.history["load_factor"], 1.0))
    return run.history["monitor:end:ux"][at]


@pytest.mark.parametrize("change", ["", "cover = { size = 0.7 }"])
@pytest.mark.parametrize("cover", COVERS)
def test_an_elastic_bar_goes_on_with_the_new_modulus_from_where_it_is(cover, change):
    if cover == "block" and change:
        pytest.skip("blocks have no cells")
    run = nmm.run(bar(ELASTIC["first"], ELASTIC["second"], cover, change))
    pulled, on = 4e3 * 4 / E1, 4e3 * 4 / E1 + 3e3 * 4 / E2
    back = on - 7e3 * 4 / E2
    # A block is held by springs of 1e4 E over its size, which are those of the material.
    within = 5e-4 if cover == "block" else 1e-6
    assert ends(run) == pytest.approx([pulled, pulled, on, back], rel=within)


def test_what_is_stored_more_in_a_softer_bar_is_told():
    run = nmm.run(bar(ELASTIC["first"], ELASTIC["second"]))
    expected = 4e3**2 / 2 * (1 / E2 - 1 / E1) * 4
    assert run.history["change_energy"][-1] == pytest.approx(expected, rel=1e-6)
    assert abs(run.summary.energy_balance) < 1e-9


def test_the_stress_of_frames_is_that_of_the_load_throughout():
    run = nmm.run(bar(ELASTIC["first"], ELASTIC["second"]))
    for frame in run.frames[1:]:
        pull = {"pulled": 4e3 * frame.load_factor, "other": 4e3}.get(frame.stage)
        if pull is not None:
            assert frame.stress[:, 0] == pytest.approx(pull, rel=1e-6)


@pytest.mark.parametrize("change", ["", "cover = { size = 0.7 }"])
def test_an_elastic_bar_that_may_flow_from_now_on_flows_at_its_yield_stress(change):
    run = nmm.run(bar(ELASTIC["first"], f"{FLOWS}young_modulus = {E2}", "quads", change))
    pulled = 4e3 * 4 / E1
    on = pulled + 3e3 * 4 / E2 + (7e3 - YIELD) * 4 / HARD
    assert ends(run) == pytest.approx([pulled, pulled, on, on - 7e3 * 4 / E2], rel=1e-6)


def test_a_bar_that_has_flowed_keeps_its_plastic_strain():
    first = f"{FLOWS}young_modulus = {E1}".replace(f"{YIELD}", "3e3")
    second = f"{FLOWS}young_modulus = {E2}".replace(f"{YIELD}", "3e3")
    run = nmm.run(bar(first, second))
    pulled = 4e3 * 4 / E1 + 1e3 * 4 / HARD
    on = pulled + 3e3 * 4 / E2 + 3e3 * 4 / HARD
    assert ends(run) == pytest.approx([pulled, pulled, on, on - 7e3 * 4 / E2], rel=1e-6)


def test_a_bar_that_has_flowed_is_elastic_from_where_it_is():
    first = f"{FLOWS}young_modulus = {E1}".replace(f"{YIELD}", "3e3")
    run = nmm.run(bar(first, ELASTIC["second"]))
    pulled = 4e3 * 4 / E1 + 1e3 * 4 / HARD
    on = pulled + 3e3 * 4 / E2
    assert ends(run) == pytest.approx([pulled, pulled, on, on - 7e3 * 4 / E2], rel=1e-6)


def test_stress_from_the_start_counts_where_matter_begins_to_flow():
    """4 kPa from the start and 4 kPa of load are beyond the yield stress of 5 kPa."""
    initial = '[[initial_stresses]]\nblock = "bar"\nstress = [4e3, 0, 0]\n'
    second = f"{FLOWS}young_modulus = {E1}"
    scene = bar(f"young_modulus = {E1}", second, more=initial)
    run = nmm.run(scene)
    # Of the load of 4 kPa in place nothing moves; 7 kPa later flow by what is beyond 5.
    flowed = (7e3 - YIELD) * 4 / HARD + 3e3 * 4 / E1
    assert ends(run)[:3] == pytest.approx([0, 0, flowed], rel=1e-6, abs=1e-8)


def test_a_run_that_is_stopped_goes_on_bit_by_bit(tmp_path):
    more = "[output.checkpoint]\nevery_steps = 3\n"
    second = f"{FLOWS}young_modulus = {E2}"
    scene = bar(ELASTIC["first"], second, change="cover = { size = 0.7 }", more=more)
    check_goes_on(scene, tmp_path, 10)


@pytest.mark.parametrize(
    ("materials", "said"),
    [
        ('{ bar = "third" }', '"third": expected the name of a material'),
        ('{ rod = "second" }', "rod"),
    ],
)
def test_a_name_that_is_none_is_refused_by_line(materials, said):
    text = BAR.format(
        **ELASTIC,
        cover=COVERS["quads"],
        head="",
        held="auto",
        more=LOADS + STAGES.replace("{cover}", ""),
    )
    with pytest.raises(SceneError, match=said):
        nmm.parse_scene(text.replace('{ bar = "second" }', materials))


def test_finite_strain_is_refused():
    with pytest.raises(FormulationError, match="expected small strains"):
        nmm.run(bar(**ELASTIC, more='[formulation.rotation]\nupdate = "finite"\n'))
