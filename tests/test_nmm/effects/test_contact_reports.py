"""What a run says of its contacts: after each step, at the end, and where it fails."""

import numpy as np
import pytest
from typer.testing import CliRunner

from nmm.cli.app import app
from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text


def told(tmp_path, source, *options):
    """Exit code and output of `nmm run --steps`."""
    scene = tmp_path / "scene.toml"
    scene.write_text(source, encoding="utf-8")
    arguments = ["run", "--steps", "--out", str(tmp_path / "run"), str(scene), *options]
    found = CliRunner().invoke(app, arguments)
    return found.exit_code, found.output


def rough(options=""):
    """A tilted square falls on its corner and slides; steps of 1 ms."""
    square = text.turned(text.rectangle((-0.5, -0.5), (0.5, 0.5)), 0.4)
    square[:, 1] += 1e-4 - square[:, 1].min()
    tables = [text.material("rock"), *text.floor(20.0), text.block("square", "rock", square)]
    return text.scene(text.weighty(1e-3, duration=0.01) + options, tables)


def test_each_step_tells_its_passes_and_the_states_of_contacts(tmp_path):
    code, output = told(tmp_path, rough())
    steps = [line for line in output.splitlines() if "%  time" in line]
    lines = [line for line in steps if "pass" in line]
    assert code == 0
    assert len(steps) == 10
    # Nothing is near in the first steps; then a corner comes near, and touches.
    assert "1 open" in lines[0]
    assert any("1 stick" in line or "1 slide" in line for line in lines)


def test_a_run_that_fails_says_where_with_the_table_to_change_and_leaves_with_2(tmp_path):
    tables = [
        *text.floor(),
        text.box("block", (0, 0.001), (1, 1)),
        '[[initial_velocities]]\nblock = "block"\nvelocity = [0, -4.4]\n',
    ]
    scene = text.scene(text.weighty(1e-3, penalty=2e-5), [text.material("rock"), *tables])
    code, output = told(tmp_path, scene)
    assert code == 2
    assert "did not converge" in output
    assert "[contact] normal_penalty" in output


def test_a_block_that_nothing_holds_is_told_with_its_way_and_remedy(tmp_path):
    tables = [text.material("rock"), *text.floor(), text.box("stray", (3, 0.5), (1, 1))]
    code, output = told(tmp_path, text.scene(text.weighty(), tables))
    assert code == 4
    assert "block stray can move freely: it moves along (0.00, -1.00)" in output
    assert "or [inertia]" in output
    assert "failure load" not in output


def pile():
    """Three tilted squares that fall on each other, by Shi's passes alone; at most six of them."""
    tables = [text.material("rock"), *text.floor()]
    for number, (turn, x, y) in enumerate([(0.2, -0.3, 0.34), (-0.3, 0.3, 0.36), (0.1, 0, 0.9)]):
        square = text.turned(text.rectangle((-0.24, -0.24), (0.24, 0.24)), turn)
        tables.append(text.block(f"b{number}", "rock", square + np.array([x, y])))
    head = (
        'plane = "strain"\nduration = 0.4\n[gravity]\n[inertia]\n[contact]\n'
        '[formulation.contact]\nmax_passes = 6\noptions = { iteration = "open_close" }\n'
        "[formulation.integrator]\nstep = 4e-3\n"
    )
    return text.scene(head, tables)


@pytest.mark.slow
def test_open_close_passes_that_cycle_are_told_with_their_states_and_cut_the_step():
    said: list[str] = []
    found = run(parse_scene(pile()), progress=lambda share, line: said.append(line))
    assert found.summary.status == "converged", found.summary.sentence
    cut = [line for line in said if "cut to" in line]
    assert any("cycled between passes" in line and "/" in line for line in cut)
    assert f"{len(cut)} of them cut" in found.summary.sentence
