"""What a scene and a formulation must not be together is told before the run, and by check."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

import nmm
from nmm.cli.app import app
from nmm.formulation import Formulation, parse_formulation
from nmm.geometry import regions
from nmm.model.consistency import known_quantities
from nmm.results.references import compare
from nmm.scene import parse_scene
from nmm.stepping.drive.dynamics import InTime, Schedule, run_in_time
from nmm.stepping.prepare import prepare
from nmm.study.cases.quantities import quantity

STEP = "[formulation.integrator]\nstep = {}\n"


class Clockwork:
    """A stepper whose every step is solved, and a recorder that keeps the times."""

    integrator = SimpleNamespace(limit=np.inf)
    plan = SimpleNamespace(askers=())

    def __init__(self):
        self.times = []

    @property
    def stepper(self):
        return self

    def remember(self):
        return None

    def attempt(self, state, end, length):
        return SimpleNamespace(converged=True, state=SimpleNamespace(time=state.time + length))

    def accept(self, attempt):
        return attempt.state, None

    def step(self, state, attempt, contacts, *more):
        self.times.append(attempt.state.time)
        return ""

    def offer(self, state, stage, contacts):
        pass

    def last(self, state, stage, contacts):
        pass


@pytest.mark.parametrize(
    ("step", "count"), [(2e-4, 20_000), (0.1, 10), (0.1, 3), (1 / 3, 3), (1e-5, 100_000)]
)
def test_a_duration_of_whole_steps_takes_as_many(step, count):
    seen = Clockwork()
    schedule = Schedule(duration=count * step, step=step)
    at = InTime.at_start(SimpleNamespace(time=0.0), schedule)
    run_in_time(seen, seen, at, schedule, lambda share, text: None)
    assert len(seen.times) == count
    # Steps are equal but for the rounding of a sum.
    assert np.diff(seen.times).min() > (1 - 1e-6) * step
    assert seen.times[-1] == pytest.approx(count * step, rel=1e-12)


def test_a_run_has_all_columns_that_references_may_name_and_no_others(projectile):
    contact = '[contact]\n[interfaces.i]\nfriction_angle = 0.5\n[[blocks]]\nmaterial = "m"\n'
    contact += "vertices = [[0, -1], [1, -1], [1, 0], [0, 0]]\n"
    held = '[[supports]]\nname = "s"\nblock = "b"\nfix = ["x"]\n[[monitors]]\nname = "o"\n'
    scene = parse_scene(projectile + contact + held + "point = [1, 1]\n" + STEP.format(0.1))
    assert set(nmm.run(scene).history) <= set(known_quantities(scene))


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (STEP.format(2.0), "longer than the duration of 1 s"),
        (STEP.format(1e-15), "allow more: NMM_MEMORY="),
        (
            '[[stages]]\nname = "s"\nduration = "1000 d"\n' + STEP.format(1e-3),
            "8.64e+10 steps, about",
        ),
        ('[[stages]]\nname = "s"\nduration = "1 h"\n', "3.6e+06 steps of 0.001 s, the default"),
        (
            '[[reference]]\nquantity = "monitor:tip:uy"\nvalue = 1\ntolerance = 1\nsource = "x"\n',
            "reference.0.quantity",
        ),
        ('[[initial_velocities]]\nblock = "all"\n', '"b" has one from initial_velocities.0'),
        ('[[cracks]]\nname = "c"\npoints = [[5, 5], [6, 6]]\n', "outside of all blocks"),
        ('[formulation.cover]\ntype = "quads"\nsize = 1e-6\n', "cells, about"),
        ('[formulation.cover]\ntype = "triangles"\nsize = 1e-6\n', "cells, about"),
        ('[formulation.cover]\ntype = "mls"\nsize = 1e-9\n', "cells, about"),
        ('[formulation.cover]\ntype = "sub_blocks"\nsize = 1e-6\n', "cells, about"),
        ('[formulation.solver]\ntype = "lu"\noptions = { speed = 1 }\n', "speed"),
        ('[formulation.contact]\nenforcement = "glue"\n', "enforcement"),
        ('[formulation.cover]\ntype = "block"\noptions = { mesh = 1 }\n', "mesh"),
        ('[formulation.cover]\ntype = "block"\ndegree = 2\n', "degree: 2"),
        (
            '[[tessellations]]\nname = "t"\nmaterial = "m"\nblocks = 1000000000\n'
            "region = [[5, 0], [6, 0], [6, 1]]\n",
            "1,000,000,000 blocks",
        ),
        (
            '[[joint_sets]]\nname = "one"\ndip = 0\nspacing = 1e-4\n'
            '[[joint_sets]]\nname = "two"\ndip = 1\nspacing = 1e-4\n',
            "blocks between joints",
        ),
    ],
)
def test_check_finds_what_a_run_refuses(projectile, more, said, tmp_path):
    whole = "" if "stages" in more else "duration = 1.0\n"  # or each stage has its own
    text = projectile.replace("duration = 1.0\n", whole) + more
    with pytest.raises(nmm.NmmError, match=re.escape(said)):
        nmm.run(parse_scene(text, "a.toml"))
    (tmp_path / "a.toml").write_text(text)
    result = CliRunner().invoke(app, ["check", str(tmp_path / "a.toml")])
    assert result.exit_code == 1
    assert said in result.output
    assert "a.toml:" in result.output  # and in which line


def test_a_step_that_is_asked_for_is_taken_a_million_times(projectile):
    hour = projectile.replace("duration = 1.0", 'duration = "1 h"')
    with pytest.raises(nmm.NmmError, match=r"3\.6e\+06 steps of 0\.001 s, the default"):
        prepare(parse_scene(hour), Formulation())
    asked = parse_scene(hour + STEP.format(1e-3))
    prepare(asked, asked.formulation)


def test_references_take_the_names_that_studies_take(projectile):
    answer = '[[reference]]\nquantity = "{}"\nvalue = 0\ntolerance = 1\nsource = "x"\n'
    names = ("energy", "max:kinetic_energy", "min:kinetic_energy", "kinetic_energy")
    scene = parse_scene(projectile + "".join(map(answer.format, names)) + STEP.format(0.5))
    run = nmm.run(scene)
    found = [one.found for one in compare(run.summary, run.history, scene.references)]
    assert found == [quantity(run, name) for name in names]
    # Of a fall from 4 m/s, seen after 0.5 and 1 s; the spin bulges the square by 5e-4.
    middle, end = (500 * (9 + (4 - 9.81 * time) ** 2 + 4 / 6) for time in (0.5, 1.0))
    assert found[1:] == pytest.approx([end, middle, end], rel=1e-3)


HELD = '[[supports]]\nname = "{}"\n{}\nfix = ["{}"]\ndisplacement = [{}, 0]\n'
BLOCK, POINT = 'block = "b"', "point = [0, 0]"
EDGE, PART = "segment = [[0, 0], [1, 0]]", "segment = [[0.5, 0], [2, 0]]"
BESIDE, TOP = "segment = [[1, 0], [1, 1]]", "segment = [[0, 1], [1, 1]]"


@pytest.mark.parametrize("places", [(BLOCK, BLOCK), (BLOCK, EDGE), (POINT, BLOCK), (EDGE, PART)])
@pytest.mark.parametrize("turned", [False, True])
def test_a_place_held_at_two_displacements_is_refused(projectile, places, turned):
    first, second = places[::-1] if turned else places
    text = projectile + HELD.format("one", first, "x", 0) + HELD.format("two", second, "x", 0.1)
    with pytest.raises(nmm.NmmError, match="at two displacements"):
        regions(parse_scene(text))


@pytest.mark.parametrize("places", [(EDGE, TOP), (EDGE, BESIDE), (POINT, TOP)])
def test_places_apart_may_be_held_at_two_displacements(projectile, places):
    text = (
        projectile + HELD.format("one", places[0], "x", 0) + HELD.format("two", places[1], "x", 1)
    )
    regions(parse_scene(text))
    same = projectile + HELD.format("one", EDGE, "x", 0.1) + HELD.format("two", BLOCK, "x", 0.1)
    regions(parse_scene(same))


def test_an_edge_held_twice_along_one_axis_is_refused(projectile):
    # Each would take all of its traction: a bar moved by 1 % more, reactions were twice its load.
    text = projectile + HELD.format("one", EDGE, "x", 0) + HELD.format("two", PART, "x", 0)
    with pytest.raises(nmm.NmmError, match='"two" and "one" hold one edge along x'):
        regions(parse_scene(text))
    regions(parse_scene(text.replace('["x"]', '["y"]', 1)))


def test_an_edge_may_be_held_by_one_support_in_each_stage(projectile):
    text = projectile.replace("duration = 1.0\n", "")
    text += HELD.format("one", EDGE, "x", 0) + HELD.format("two", EDGE, "x", 0.1)
    stage = '[[stages]]\nname = "{0}"\nduration = 1\nsupports = ["{0}"]\n'
    regions(parse_scene(text + stage.format("one") + stage.format("two")))
    with pytest.raises(nmm.NmmError, match="at two displacements"):
        regions(
            parse_scene(text + stage.format("one") + '[[stages]]\nname = "both"\nduration = 1\n')
        )


def test_all_is_a_place_of_loads_and_supports(projectile):
    load = '[[loads]]\nname = "l"\nkind = "body"\nblock = "all"\ndensity = [9, 0]\n'
    text = projectile + load
    alone = text.replace('block = "all"\n', "")
    ways = [nmm.run(parse_scene(one + STEP.format(0.5))).displacement for one in (text, alone)]
    assert np.array_equal(*ways)


def test_the_limit_of_memory_is_the_users(monkeypatch, projectile):
    text = projectile + '[formulation.cover]\ntype = "quads"\nsize = 0.05\n'
    monkeypatch.setenv("NMM_MEMORY", "0.001 GB")
    with pytest.raises(nmm.NmmError, match='allow more: NMM_MEMORY="'):
        prepare(parse_scene(text), parse_scene(text).formulation or Formulation())
    monkeypatch.setenv("NMM_MEMORY", "plenty")
    with pytest.raises(nmm.NmmError, match="gigabytes"):
        prepare(parse_scene(text), parse_scene(text).formulation or Formulation())


@pytest.mark.parametrize(
    "text",
    ["a = " + "[" * 3000 + "]" * 3000, "a = " + "9" * 5000, "a = " + "{b = " * 99 + "1" + "}" * 99],
)
def test_text_beyond_all_measure_is_one_line(text):
    for read in (parse_scene, parse_formulation):
        with pytest.raises(nmm.NmmError) as caught:
            read(text)
        assert len(str(caught.value).splitlines()) == 1


def test_a_byte_order_mark_is_no_part_of_a_file(tmp_path, projectile):
    (tmp_path / "a.toml").write_bytes(b"\xef\xbb\xbf" + projectile.encode())
    assert nmm.read_scene(tmp_path / "a.toml") == parse_scene(projectile)


@pytest.mark.parametrize("value", ["1e-300", "1e31", "5e-324"])
def test_moduli_beyond_all_matter_are_refused(projectile, value):
    with pytest.raises(nmm.NmmError, match="young_modulus"):
        parse_scene(projectile.replace("1e7", value))
