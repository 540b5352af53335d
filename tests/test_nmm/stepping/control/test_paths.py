"""Paths past the peak against closed forms: bars that snap back, bundles, columns, a zipper."""

import numpy as np
import pytest

import nmm
from nmm.scene import parse_scene
from nmm.verification import text

# A bar of 1 m x 100 mm2 as in the closed form: N, m.
MODULUS, AREA, STRENGTH, ENERGY = 30e9, 1e-4, 3e6, 100.0


def bar(length, energy, control, law="linear", more="", strength=STRENGTH):
    """Two halves of a bar, held left and pulled right by 1 N, bonded by a law that softens."""
    joint = {"cohesion": 1e9, "tensile_strength": strength, "bonded": True}
    high = 0.01
    softening = "" if energy is None else f"fracture_energy = {energy!r}\n"
    softening += "" if energy is None or law == "linear" else f'law = "{law}_softening"\n'
    half = length / 2
    return text.scene(
        f'plane = "stress"\nthickness = {AREA / high!r}\n[contact]\n'
        f'[loading]\nuntil = "failure"\n[loading.control]\n{control}',
        [
            text.material("rock", modulus=MODULUS, poisson=0.0),
            text.interface("joint", 30.0, more=joint) + softening,
            text.block("a", "rock", text.rectangle((0, 0), (half, high))),
            text.block("b", "rock", text.rectangle((half, 0), (length, high))),
            f'[[supports]]\nname = "left"\nsegment = [[0, 0], [0, {high}]]\nfix = ["x", "y"]\n',
            f'[[loads]]\nname = "pull"\nkind = "edge"\ntraction = [{1 / AREA!r}, 0]\n'
            f"segment = [[{length}, 0], [{length}, {high}]]\n",
            # Without it the halves turn as they part: one end of the joint opens before the other.
            f'[[supports]]\nname = "track"\nsegment = [[{half}, 0], [{length}, 0]]\nfix = ["y"]\n',
            text.monitor("end", (length, high / 2), "b"),
            text.monitor("one", (half, high / 2), "a"),
            text.monitor("other", (half, high / 2), "b"),
            more,
        ],
    )


def opening(width, steps=20):
    return (
        f'type = "opening"\nmonitors = ["other", "one"]\nincrement = {width / steps!r}\n'
        f"end = {1.05 * width!r}\n"
    )


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1 + 1e-9, 2.0, 100.0])
def test_a_bar_that_softens_snaps_back_as_far_as_it_is_long(ratio):
    # The critical length is 2 E GF / ft^2: the path falls straight from the peak to (w, 0).
    critical = 2 * MODULUS * ENERGY / STRENGTH**2
    length, width = ratio * critical, 2 * ENERGY / STRENGTH
    run = nmm.run(parse_scene(bar(length, ENERGY, opening(width))))
    force, way = run.history["load_factor"], run.history["monitor:end:ux"]
    assert run.summary.status == "failure_load"
    assert run.summary.failure_factor == pytest.approx(STRENGTH * AREA, rel=1e-8)
    peak = STRENGTH * length / MODULUS
    # A straight line from (peak, 300 N) to (width, 0): the held end and the springs that take over
    # give by 1e-3 of the bar and of the crack.
    line = np.interp(-force, [-300.0, 0.0], [peak, width])
    assert np.abs(way - line).max() < 2e-3 * max(width, peak)
    assert force[-1] < 1e-3 * 300
    work = run.history["external_work"][-1]
    assert work == pytest.approx(ENERGY * AREA, rel=2e-4 * max(ratio, 1))
    assert run.history["friction_loss"][-1] == pytest.approx(work, rel=1e-4 * max(ratio, 1))


def test_two_straight_pieces_of_a_law_are_two_of_the_path():
    width = 3.6 * ENERGY / STRENGTH
    run = nmm.run(parse_scene(bar(1.0, ENERGY, opening(width, 36), law="bilinear")))
    crack = run.history["monitor:other:ux"] - run.history["monitor:one:ux"]
    knee = np.interp(0.8 * ENERGY / STRENGTH, crack[1:], run.history["load_factor"][1:])
    assert knee == pytest.approx(100.0, rel=1e-2)


@pytest.mark.parametrize("ratio", [0.5, 2.0])
def test_steps_that_each_dissipate_the_same_go_round_the_same_path(ratio):
    length = ratio * 2 * MODULUS * ENERGY / STRENGTH**2
    total = ENERGY * AREA
    control = f'type = "dissipation"\nenergy = {total / 10!r}\nend_energy = {0.95 * total!r}\n'
    run = nmm.run(parse_scene(bar(length, ENERGY, control)))
    assert run.summary.failure_factor == pytest.approx(300.0, rel=1e-8)
    # Steps that were cut take a half, a quarter, ... of it.
    lost = np.diff(run.history["friction_loss"])
    assert lost.max() == pytest.approx(total / 10, rel=1e-3)
    assert run.history["friction_loss"][-1] == pytest.approx(0.95 * total, rel=1e-3)
    # A linear law unloading to its origin dissipates ft w / 2: of the load a twentieth is left.
    assert run.history["load_factor"][-1] == pytest.approx(0.05 * 300, rel=5e-3)


def bundle(thresholds, control, until=""):
    """Links of 1 N/um, driven together at their tops: the load factor is the way in um."""
    width = 0.1
    tables = [text.material("rock", modulus=1e6 / width, poisson=0.0)]
    tables += [text.material(f"f{n}", modulus=1e14, poisson=0.0) for n in range(len(thresholds))]
    for number, strength in enumerate(thresholds):
        left = number * 0.3
        more = {"cohesion": 1e9, "bonded": True, "tensile_strength": strength / width}
        ends = f"[[{left}, 1], [{left + width}, 1]]"
        tables += [
            text.interface(f"i{number}", 30.0, (f"f{number}", "rock"), more),
            text.block(f"c{number}", "rock", text.rectangle((left, 0), (left + width, 1))),
            text.block(f"b{number}", f"f{number}", text.rectangle((left, -1), (left + width, 0))),
            text.held(f"b{number}"),
            f'[[supports]]\nname = "s{number}"\nsegment = {ends}\nfix = ["x", "y"]\n'
            "displacement = [0, 1e-6]\n",
        ]
    head = f'plane = "stress"\n[contact]\n[loading]\nuntil = "failure"\n{until}'
    return text.scene(f"{head}[loading.control]\n{control}", tables)


def pull(run, count):
    return sum(run.history[f"reaction:s{number}:y"] for number in range(count))


LINKS = (1.05, 0.82, 1.31, 0.64, 1.47, 0.93, 1.18, 0.71, 1.26, 1.02)


def test_links_of_a_bundle_break_one_by_one_in_the_order_of_their_strength():
    run = nmm.run(parse_scene(bundle(LINKS, 'type = "events"\n')))
    known = [6.40, 6.39, 6.56, 6.51, 6.12, 5.25, 4.72, 3.78, 2.62, 1.47]
    assert pull(run, len(LINKS)) == pytest.approx(known, rel=1e-8)
    # Supports of 1000 E over what is held give by 3e-4 of a link.
    assert run.history["load_factor"] == pytest.approx(sorted(LINKS), rel=1e-3)
    assert run.summary.status == "converged"


def test_links_of_one_strength_break_in_one_event():
    run = nmm.run(parse_scene(bundle((1.0, 2.0, 1.0), 'type = "events"\n')))
    assert pull(run, 3)[:2] == pytest.approx([3.0, 2.0], rel=1e-6)
    assert run.history["broken"][1] == 4


@pytest.mark.parametrize("apart", [1e-15, 1e-10, 1e-6, 1e-4])
def test_links_of_nearly_one_strength_break_as_their_strengths_tend_to_each_other(apart):
    run = nmm.run(parse_scene(bundle((1.0, 1.0 + apart), 'type = "events"\n')))
    assert pull(run, 2)[0] == pytest.approx(2.0, rel=1e-6)


def test_a_brittle_bar_is_followed_back_to_nothing_under_no_control_of_its_own():
    control = 'type = "displacement"\nmonitors = ["end"]\nincrement = "50 um"\nend = "0.2 mm"\n'
    run = nmm.run(parse_scene(bar(1.0, None, control)))
    assert run.summary.failure_factor == pytest.approx(300.0, rel=1e-8)
    force, way = run.history["load_factor"], run.history["monitor:end:ux"]
    peak = int(force.argmax())
    assert way[peak] == pytest.approx(1e-4, rel=2e-2)


def test_columns_of_three_heights_break_one_by_one_under_one_way():
    # E A / L = 20, 10, 5 kN/mm and strengths 200, 250, 400 N: forces before and after each break.
    width, strengths = 0.1, (200.0, 250.0, 400.0)
    scene = bundle(strengths, 'type = "displacement"\nmonitors = ["top"]\ndirection = [0, 1]\n')
    for number, stiffness in enumerate((20e6, 10e6, 5e6)):
        old = f'name = "c{number}"\nmaterial = "rock"'
        scene = scene.replace(old, f'name = "c{number}"\nmaterial = "rock{number}"')
        scene = scene.replace(f'["f{number}", "rock"]', f'["f{number}", "rock{number}"]')
        scene += text.material(f"rock{number}", modulus=stiffness / width, poisson=0.0)
    scene = scene.replace(
        "direction = [0, 1]", 'direction = [0, 1]\nincrement = "3 um"\nend = "90 um"'
    )
    scene += text.monitor("top", (0.05, 1), "c0")
    run = nmm.run(parse_scene(scene))
    way, force, broken = run.history["load_factor"], pull(run, 3), run.history["broken"]
    events = np.flatnonzero(np.diff(broken) > 0)
    assert force[events] == pytest.approx([350.0, 375.0, 400.0], rel=1e-8)
    assert force[events + 1] == pytest.approx([150.0, 125.0, 0.0], rel=1e-4, abs=1e-6)
    # Supports of 1000 E over what is held give by 3e-4 of a column.
    assert way[events] == pytest.approx([10.0, 25.0, 80.0], rel=1e-3)


def test_a_control_of_the_example_keeps_what_every_control_keeps():
    from nmm.testing import check_control

    check_control(nmm.read_scene("examples/snap_back/bar.toml"))


@pytest.mark.parametrize(
    ("table", "fault"),
    [
        ('type = "opening"\nmonitors = ["end"]\nincrement = 1e-6\n', "1 monitors"),
        ('type = "displacement"\nmonitors = ["end"]\n', "without increment"),
        ('type = "displacement"\nmonitors = ["nobody"]\nincrement = 1e-6\n', '"nobody"'),
        ('type = "dissipation"\nenergy = -1\n', "energy"),
        ('type = "evnts"\n', "evnts"),
        ('type = "events"\ndirection = [0, 0]\n', "direction"),
    ],
)
def test_a_control_at_fault_is_told_before_anything_runs(table, fault):
    with pytest.raises(nmm.NmmError) as error:
        nmm.run(parse_scene(bar(1.0, ENERGY, table)))
    assert fault in str(error.value)


def test_a_path_with_checkpoints_is_refused():
    more = "[output.checkpoint]\nevery_steps = 1\n"
    with pytest.raises(nmm.NmmError, match="checkpoint besides"):
        nmm.run(parse_scene(bar(1.0, ENERGY, 'type = "events"\n', more=more)))


@pytest.mark.parametrize("more", ['[formulation.contact]\nenforcement = "lagrange"\n'])
def test_a_path_without_springs_of_contact_is_refused(more):
    with pytest.raises(nmm.NmmError, match=r"loading\.control"):
        nmm.run(parse_scene(bar(1.0, ENERGY, 'type = "events"\n', more=more)))
