"""Cracks that grow: which way, when, where they end, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

import nmm
from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.formulation import Formulation, parse_formulation
from nmm.fracture.growth.advance import extended_lines
from nmm.fracture.growth.fronts import CrackFronts
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene.model import Scene
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare
from nmm.stepping.run import Run
from nmm.testing.cracked_plates import PULLED, notched_plate, turned_net
from nmm.testing.resumed.stopping import check_goes_on
from nmm.verification import text
from nmm.verification.continuum import polygon
from nmm.verification.problems.cracks import crack_scenes

DRIVEN = """
[[supports]]
name = "up"
segment = [[0, 0.5], [1, 0.5]]
fix = ["x", "y"]
displacement = [0.0, 1.0]
"""
NET = turned_net(0.125)
FOLLOW = 'toughness = 1.0\nincrement = 0.1\nmax_growth = 0.2\ncontrol = "toughness"'


def plate(fracture: str = FOLLOW, pulled: str = PULLED, tip: float = 0.3) -> Scene:
    return parse_scene(notched_plate(fracture, pulled, tip))


def net() -> Formulation:
    return parse_formulation(NET)


def test_every_step_of_a_followed_crack_is_at_its_toughness() -> None:
    run = nmm.run(plate(), net())
    history = run.history
    assert run.summary.status == "converged"
    assert np.array(history["fracture:notch:end:share"]) == pytest.approx(np.ones(3), abs=1e-9)
    assert history["fracture:notch:end:growth"] == pytest.approx([0.0, 0.1, 0.2], abs=1e-12)
    assert history["fracture:growth"] == pytest.approx([0.0, 0.1, 0.2], abs=1e-12)
    # A longer edge crack needs less load.
    assert (np.diff(history["load_factor"]) < 0).all()
    rate = (np.array(history["fracture:notch:end:K_I"]) ** 2) * (1 - 0.3**2)
    assert history["fracture:notch:end:G"] == pytest.approx(rate, rel=1e-2)


def test_an_end_notched_beam_slides_on_at_its_fracture_energy() -> None:
    """G = 9 P^2 (a + 0.279 h)^2 / (16 E' h^3) (Williams 1989; Wang and Williams 1992).

    Both arms share the force at their ends, so that nothing but shear is at the tip; K_I is
    rounding, of either sign.
    """
    h, span, modulus, energy = 0.1, 4.0, 10e9, 100.0
    pushes = {
        "left": ([[0, -h], [0, h]], 0.25 / h),
        "middle": ([[span / 2 - 0.1, h], [span / 2 + 0.1, h]], -5.0),
        "right": ([[span, -h], [span, h]], 0.25 / h),
    }
    tables = [
        text.material("m", modulus, 0.25, None),
        text.block("beam", "m", text.rectangle((0, -h), (span, h))),
        crack_scenes.crack("c", [[0, 0], [1.0, 0]]),
        *(text.pulled_edge(name, edge, [0, pull]) for name, (edge, pull) in pushes.items()),
        text.fixed_point("foot", [span, -h]),
        text.fixed_point("below", [span / 2, -h], "y"),
        crack_scenes.grown(0.2, 0.6, f'energy = {energy}\ncriterion = "straight_ahead"'),
        crack_scenes.net(h / 2, 7.0),
    ]
    run = nmm.run(parse_scene(text.scene('plane = "strain"', tables)))
    a, force = run.history["fracture:c:end:x"], run.history["load_factor"]
    assert a == pytest.approx([1.0, 1.2, 1.4, 1.6])
    expected = np.sqrt(16 * modulus / (1 - 0.25**2) * h**3 * energy / 9) / (a + 0.279 * h)
    # The correction of the length is a fit; measured 0.4 to 0.7 %, as on quads of degree 2.
    assert force == pytest.approx(expected, rel=0.01)
    assert run.summary.audits["growth_energy"] < 1e-3


def arms(acting: list[str]) -> Run:
    """Return the run of two arms, 0.1 m high and clamped at 2.4 m, that a crack of 0.8 m parts."""
    tables = [
        text.material("m", 10e9, 0.25, None),
        text.block("beam", "m", text.rectangle((0, -0.1), (2.4, 0.1))),
        crack_scenes.crack("c", [[-0.1, 0], [0.8, 0]]),
        text.fixed_edge("wall", [[2.4, -0.1], [2.4, 0.1]]),
        *acting,
        crack_scenes.grown(0.2, 0.4, 'energy = 100.0\ncriterion = "straight_ahead"'),
        crack_scenes.net(0.05, 7.0),
    ]
    return nmm.run(parse_scene(text.scene('plane = "strain"', tables)))


def test_dead_forces_beside_the_ends_of_arms_leave_a_live_load_what_they_spare() -> None:
    """G = 12 (M + 0.6728 h V)^2 / (E' h^3), M and V at the tip, at the fracture energy.

    As of a double cantilever beam under its end load (Foote and Buchwald 1985); the dead forces
    act 4 h or more from the tip.
    """
    h, dead, beside = 0.1, 1.5e3, 0.4
    force = '[[loads]]\nname = "{}"\nkind = "point"\npoint = [0.4, {}]\nforce = [0, {}]\n'
    run = arms(
        [
            text.pulled_edge("up", [[0, 0], [0, h]], [0, 1e4]),
            text.pulled_edge("down", [[0, -h], [0, 0]], [0, -1e4]),
            force.format("dead up", h, dead),
            force.format("dead down", -h, -dead),
            '[loading]\nscaled = ["up", "down"]\n',
        ]
    )
    a = np.array([0.8, 1.0, 1.2])
    bears = np.sqrt(10e9 / (1 - 0.25**2) * h**3 * 100.0 / 12)
    live = (bears - dead * (a - beside + 0.6728 * h)) / (a + 0.6728 * h)
    assert 1e3 * run.history["load_factor"] == pytest.approx(live, rel=5e-3)
    assert run.summary.audits["growth_energy"] < 1e-3
    assert abs(run.summary.energy_balance) < 1e-3


def test_supports_that_drive_arms_apart_free_what_the_toughness_takes() -> None:
    # Chords of a displacement miss as much as those of a load, the other way: once 1.2 %.
    driven = '[[supports]]\nname = "{}"\npoint = [0, {}]\nfix = ["y"]\ndisplacement = [0, {}]\n'
    ends = [driven.format("up", 0.1, 1e-3), driven.format("down", -0.1, -1e-3)]
    audits = arms([*ends, "[loading]\n"]).summary.audits
    assert audits["growth_energy"] < 1e-3


def test_weight_below_a_crack_spares_the_load_that_opens_it() -> None:
    """A strip hangs: across the crack it bears the load and the weight below, w = rho g H."""
    below, weight = 1.5, 0.4
    loads = []
    for pulls, more in ((0.0, ""), (weight, "[gravity]\n[loading]\n")):
        tables = [
            text.material("m", 1.0, 0.3, pulls / below / 9.81 or None),
            text.box("b", (0, -below), (1, 2 * below), "m"),
            crack_scenes.crack("notch", [[-0.1, 0], [0.3, 0]]),
            text.fixed_edge("roof", [[0, below], [1, below]]),
            text.pulled_edge("live", [[0, -below], [1, -below]], [0, -1.0]),
            crack_scenes.grown(0.1, 0.1),
            more,
        ]
        run = nmm.run(parse_scene(text.scene('plane = "strain"', tables)), net())
        loads.append(np.array(run.history["load_factor"]))
        assert run.summary.audits["growth_energy"] < 1e-3
    # The weight of the two cells on either side does not pull across the crack evenly.
    assert loads[1] == pytest.approx(loads[0] - weight, abs=2e-3 * loads[0].min())


def test_crack_opens_in_proportion_to_its_load_whatever_the_unit_of_strain() -> None:
    # Linear elasticity: a million times the load, a million times the opening, to rounding.
    openings = [
        nmm.run(plate(FOLLOW.replace("toughness = 1.0", f"toughness = {size}")), net()).history
        for size in (1e-6, 1.0)
    ]
    small, large = (np.array(h["fracture:notch:opening"]) for h in openings)
    assert large == pytest.approx(1e6 * small, rel=1e-8)


def test_a_crack_along_its_load_is_opened_by_none() -> None:
    # Plane stress state along the crack alone: K is zero, its integral 1e-6 of that of a crack
    # across. By that error the plate was torn at 4e5 times the load.
    along = notched_plate(FOLLOW).replace("[[-0.1, 0.0], [0.3, 0.0]]", "[[0.5, -0.2], [0.5, 0.2]]")
    floor = along.index("[[supports]]"), along.index("[[loads]]")
    held = """
[[supports]]
name = "pin"
point = [0, -0.5]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [1, -0.5]
fix = ["y"]
[[loads]]
name = "down"
kind = "edge"
segment = [[0, -0.5], [1, -0.5]]
traction = [0, -1.0]
"""
    run = nmm.run(parse_scene(along[: floor[0]] + held + along[floor[1] :]), net())
    assert run.summary.status == "failed"
    assert "no load factor opens a crack" in run.summary.sentence
    assert run.summary.fracture_energy == 0.0


def test_a_crack_grows_under_supports_that_are_driven_at_once_without_halves_of_a_load() -> None:
    # No factor scales them: increments were halved down to 1e-9 of a load that is not there.
    rule = "toughness = 0.9\nincrement = 0.1\nmax_growth = 0.2"
    run = nmm.run(plate(rule, DRIVEN.replace("1.0]", "4.0]")), net())
    assert run.history["load_factor"] == pytest.approx([1.0] * 3)
    assert run.history["fracture:growth"] == pytest.approx([0.0, 0.1, 0.2], abs=1e-9)
    assert run.summary.sentence == "equilibrium at load factor 1"


def test_what_growth_takes_is_missing_in_the_stored_energy() -> None:
    # Irwin: G = K^2 / E' for every unit of growth, whatever the net resolves of it.
    run = nmm.run(plate(FOLLOW.replace("0.1", "0.05")), net())
    work, stored = run.history["external_work"][-1], run.history["strain_energy"][-1]
    held = run.history["support_energy"][-1]
    taken = run.history["fracture:energy"][-1]
    assert taken == pytest.approx(0.2 * (1 - 0.3**2), rel=1e-9)
    # Measured 4 % of what is taken with eight cells across, 0.4 % of the energies at work.
    assert work - stored - held == pytest.approx(taken, rel=0.08)
    assert abs(run.summary.energy_balance or 0.0) < 1e-9


def test_driven_edges_hold_a_crack_that_loads_would_not() -> None:
    """Under growing loads: pieces come one after the other, each at its toughness."""
    fracture = "toughness = 1.0\nincrement = 0.1\nmax_growth = 0.1"
    scene = parse_scene(notched_plate(fracture, DRIVEN) + "[loading]\nuntil = 6.0\n")
    how = parse_formulation(NET + "[loading]\nincrement = 1.0\ntolerance = 1e-2\n")
    run = nmm.run(scene, how)
    share, grown = (
        np.array(run.history[f"fracture:notch:end:{key}"]) for key in ("share", "growth")
    )
    began = int(np.flatnonzero(grown > 0)[0])
    assert share[began - 1] == pytest.approx(1.0, abs=2e-2)
    assert run.history["load_factor"][-1] == pytest.approx(6.0)
    assert grown[-1] == pytest.approx(0.1)


def test_growth_to_the_far_side_frees_a_piece_and_ends() -> None:
    run = nmm.run(plate('toughness = 1.0\nincrement = 0.11\ncontrol = "toughness"', tip=0.7), net())
    assert "a piece came free" in run.summary.sentence
    assert len(run.summary.changes) == 3


def test_a_run_that_is_stopped_goes_on_to_the_same_cracks(tmp_path: Path) -> None:
    text = notched_plate(FOLLOW)
    scene = parse_scene(text + "[output]\ncheckpoint = { every_steps = 1 }\n")
    assert check_goes_on(scene, tmp_path, 1, net()).summary.changes


def test_the_critical_one_of_two_cracks_grows_first() -> None:
    text = notched_plate(FOLLOW)
    other = '[[cracks]]\nname = "short"\npoints = [[1.1, 0.2], [0.9, 0.2]]\n[[supports]]'
    run = nmm.run(parse_scene(text.replace("[[supports]]", other, 1)), net())
    # The other one follows where the first has come as far as it may.
    assert run.history["fracture:notch:end:growth"][:3] == pytest.approx([0.0, 0.1, 0.2])
    assert run.history["fracture:short:end:growth"] == pytest.approx([0.0, 0.0, 0.0, 0.1, 0.2])


@pytest.mark.parametrize(
    ("cut", "begin", "way", "expected"),
    [
        # Far from everything, short of the edge by a tenth of the length, and beyond it.
        (0.5, 0.0, 0.0, 0.6),
        (0.89, 0.0, 0.0, 1.0),
        (0.95, 0.0, 0.0, 1.0),
        # Short of it by half the length: a ligament stays.
        (0.85, 0.0, 0.0, 0.95),
    ],
)
def test_a_piece_ends_on_what_it_meets(
    cut: float, begin: float, way: float, expected: float
) -> None:
    found = grown([np.array([[-0.1, begin], [cut, begin]])], [1], way)[0]
    assert found[-1] == pytest.approx([expected, begin], abs=1e-9)


def test_a_piece_ends_on_another_crack() -> None:
    wall = np.array([[0.55, -0.2], [0.55, 0.3]])
    found = grown([np.array([[-0.1, 0.0], [0.5, 0.0]]), wall], [1], 0.0)
    assert found[0][-1] == pytest.approx([0.55, 0.0], abs=1e-12)
    assert np.array_equal(found[1], wall)


def test_both_ends_of_a_crack_grow_and_turn_as_asked() -> None:
    line = np.array([[0.4, 0.0], [0.6, 0.0]])
    found = grown([line], [0, 1], np.pi / 2)[0]
    assert found[0] == pytest.approx([0.4, -0.1], abs=1e-12)
    assert found[-1] == pytest.approx([0.6, 0.1], abs=1e-12)
    assert np.array_equal(found[1:3], line)


def grown(cracks: list[Floats], fronts: list[int], angle: float) -> tuple[Floats, ...]:
    """Return cracks in the plate of the tests after pieces of 0.1 at some fronts."""
    ring = [[0.0, -0.5], [1.0, -0.5], [1.0, 0.5], [0.0, 0.5]]
    model = solid(polygon(ring), net().cover, [Elastic(1.0, 0.3)], "strain", cracks=cracks)
    ends = CrackFronts.of([f"c{number}" for number in range(len(cracks))])
    which = np.array(fronts)
    tips = ends.tips(model.cut, cracks)[which]
    assert (tips >= 0).all()
    return extended_lines(model.cut, cracks, ends, which, tips, np.full(len(which), angle), 0.1)


def test_growth_without_a_crack_is_refused() -> None:
    text = notched_plate(FOLLOW)
    head, _, rest = text.partition("[[cracks]]")
    with pytest.raises(NmmError, match="crack"):
        parse_scene(head + rest[rest.index("[[supports]]") :])


@pytest.mark.parametrize(
    ("table", "said"),
    [("[contact]\n", "contact"), ("[inertia]\n", "inertia")],
)
def test_what_growth_does_not_go_with_is_refused(table: str, said: str) -> None:
    text = notched_plate(FOLLOW)
    with pytest.raises(NmmError, match=said):
        parse_scene(text + table)


MOVED = '[[supports]]\nname = "d"\npoint = [1, 0.4]\nfix = ["y"]\ndisplacement = [0, {way}]\n'


@pytest.mark.parametrize(
    ("way", "more"), [("1e-3", ""), ('"1 mm"', "history = [[0, 0], [1, 1]]\n")]
)
def test_displacements_that_no_factor_scales_are_refused(way: str, more: str) -> None:
    # Loads beside them are scaled, they are not: no factor would bring tips to their toughness.
    text = notched_plate(FOLLOW) + MOVED.format(way=way) + more + "[loading]\n"
    with pytest.raises(NmmError, match="the displacement of 'd'"):
        parse_scene(text)
    parse_scene(notched_plate(FOLLOW) + MOVED.format(way="0.0") + "[loading]\n")


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ("[[2.0, 0.0], [3.0, 0.0]]", "outside of all blocks"),
        ("[[-0.1, 0.0], [1.1, 0.0]]", "no crack tip"),
        ("[[0.5, 0.0], [0.51, 0.0]]", "no tip functions"),
    ],
)
def test_cracks_that_cannot_grow_are_refused(points: str, said: str) -> None:
    text = notched_plate(FOLLOW)
    scene = parse_scene(text.replace("[[-0.1, 0.0], [0.3, 0.0]]", points))
    with pytest.raises(NmmError, match=said):
        prepare(scene, net())


def test_covers_that_cannot_carry_the_growth_are_refused() -> None:
    how = net()
    plain = replace_cover(how, enrichment=nmm.formulation.EnrichmentTable(tips=False))
    with pytest.raises(NmmError, match="no tip functions"):
        prepare(plate(), plain)
    with pytest.raises(NmmError, match="cracks end inside blocks"):
        prepare(plate(), parse_formulation('[cover]\ntype = "block"\nfunctions = "rigid_strain"\n'))


def test_turns_that_no_factor_scales_are_refused() -> None:
    how = parse_formulation(NET + '[rotation]\nupdate = "exact"\n')
    with pytest.raises(NmmError, match="that a factor scales"):
        prepare(plate(), how)


def replace_cover(how: Formulation, **given: object) -> Formulation:
    return how.model_copy(update={"cover": how.cover.model_copy(update=given)})


def test_the_path_of_a_crack_is_drawn(tmp_path: Path) -> None:
    from nmm import plots
    from nmm.plots.results.crack_paths import grown_paths

    run = nmm.run(plate(FOLLOW.replace("0.2", "0.1")), net())
    (points,) = grown_paths(run).values()
    assert points[0] == pytest.approx([0.3, 0.0])
    assert np.hypot(*(points[1] - points[0])) == pytest.approx(0.1)
    plots.crack_paths(run, path=tmp_path / "paths.png")
    assert (tmp_path / "paths.png").stat().st_size > 10_000


def test_what_growth_frees_is_told_beside_what_the_toughness_takes() -> None:
    run = nmm.run(plate(FOLLOW.replace("0.1", "0.05")), net())
    summary = run.summary
    assert summary.fracture_energy == pytest.approx(0.2 * (1 - 0.3**2), rel=1e-9)
    assert summary.freed_energy == pytest.approx(summary.fracture_energy, rel=0.03)
    assert summary.freed_energy == pytest.approx(-(summary.change_energy or 0.0), rel=1e-6)


def test_faces_and_tips_of_cracks_go_to_frames_history_and_paraview(tmp_path: Path) -> None:
    from nmm.results.viewing.paraview import write_paraview

    run = nmm.run(plate(), net(), out=tmp_path / "run")
    frame, history = run.frames[-1], run.history
    faces, opening = (frame.fields[f"fracture:{key}"].values for key in ("faces", "opening"))
    # Before anything moves: from the mouth at the edge to the tip, without a gap.
    still = run.frames[0].fields
    ends = still["fracture:faces"].values
    assert np.hypot(*(ends[:, 2:] - ends[:, :2]).T).sum() == pytest.approx(0.3, abs=1e-9)
    assert still["fracture:tip"].values == pytest.approx(np.array([[0.3, 0.0]]), abs=1e-9)
    assert history["fracture:notch:length"] == pytest.approx([0.4, 0.5, 0.6], abs=1e-2)
    assert (opening > 0).all()
    # It is widest at its mouth, between the corners of elements that lay there.
    mouth = np.hypot(*(frame.points - frame.displacement).T) < 1e-9
    apart = np.ptp(frame.displacement[mouth, 1])
    assert history["fracture:notch:opening"][-1] == pytest.approx(apart, rel=1e-9)
    assert 0.8 * apart < opening.max() < apart
    assert frame.fields["fracture:K_I"].values == pytest.approx(
        history["fracture:notch:end:K_I"][-1:]
    )
    # The same from the folder, and as files.
    stored = nmm.read_run(tmp_path / "run")
    assert np.array_equal(stored.frames[-1].fields["fracture:faces"].values, faces)
    files = {path.name for path in write_paraview(stored, tmp_path / "paraview")}
    assert {"blocks.pvd", "cracks.pvd", "tips.pvd"} <= files
    assert 'Name="opening"' in (tmp_path / "paraview" / "cracks_000001.vtu").read_text()
    assert 'Name="K_I"' in (tmp_path / "paraview" / "tips_000001.vtu").read_text()


def test_domains_of_less_than_a_cell_are_refused() -> None:
    with pytest.raises(NmmError, match=r"fracture.radius: 1e-06 m: expected at least a cell"):
        prepare(plate(FOLLOW + "\nradius = 1e-6\n"), net())
