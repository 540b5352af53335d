"""An effect and an output of a user's own: table, energy, frames, history, ParaView."""

import base64
import re
import sys
import tomllib
from importlib import metadata
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import nmm
from nmm.cli.app import app
from nmm.results import read_run
from nmm.results.viewing.paraview import write_paraview
from nmm.scene.read import build_scene
from nmm.study.cases.quantities import check_quantity_name, quantity
from nmm.testing import check_effect_of, check_moved_effect
from nmm.verification.hard.cases.transforms import shifted

RAFT = Path(__file__).parents[2] / "examples" / "own_effect" / "raft.toml"
CODE = ["foundation", "steepness"]
# Load, its eccentricity, length and thickness of the raft, stiffness of the ground.
LOAD, ECCENTRICITY, LENGTH, SPRING = 1e6, 0.5, 4.0, 10e6
TILT = LOAD * ECCENTRICITY / (SPRING * LENGTH**3 / 12)
SINKS = LOAD / (SPRING * LENGTH)


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    return nmm.run(nmm.read_scene(RAFT), allow_code=CODE, out=tmp_path_factory.mktemp("raft"))


def test_a_stiff_raft_tilts_on_springs_as_a_rigid_bar(done):
    # A block of linear functions under one edge load keeps its lower edge straight.
    assert done.history["largest_tilt"][-1] == pytest.approx(TILT, rel=1e-12)
    # The outermost of the Gauss points on the edge.
    last = LENGTH / 2 * np.polynomial.legendre.leggauss(3)[0][-1]
    assert done.history["ground:settlement"][-1] == pytest.approx(SINKS + TILT * last, rel=1e-12)
    assert done.history["ground:reaction"][-1] == pytest.approx(LOAD, rel=1e-12)


def test_what_springs_of_ones_own_store_is_in_the_balance(done):
    moment = LOAD * ECCENTRICITY
    stored = LOAD * SINKS / 2 + moment * TILT / 2
    assert done.history["energy:ground"][-1] == pytest.approx(stored, rel=1e-12)
    # Of order one were the energy left out.
    assert abs(done.summary.energy_balance) < 1e-12
    assert done.summary.audits["work_not_stored"] < 1e-12


def test_quantities_of_ones_own_are_stored_and_read_again(done):
    stored = read_run(done.folder)
    assert list(stored.frames[-1].fields) == [
        "ground:pressure", "friction:pressure", "von_mises", "tilt"
    ]  # fmt: skip
    for kept, read in zip(done.frames, stored.frames, strict=True):
        for name, one in kept.fields.items():
            again = read.fields[name]
            assert (again.on, again.unit, again.components) == (one.on, one.unit, one.components)
            assert np.array_equal(again.values, one.values)
    pressure = stored.frames[-1].fields["ground:pressure"]
    assert pressure.unit == "Pa"
    assert pressure.values == pytest.approx([LOAD / LENGTH], rel=1e-12)


def test_quantities_of_ones_own_are_in_paraview(done, tmp_path):
    write_paraview(done, tmp_path)
    text = sorted(tmp_path.glob("blocks_*.vtu"))[-1].read_text()
    coded = re.search(r'Name="tilt"[^>]*>([^<]*)<', text.partition("<CellData>")[2])
    values = np.frombuffer(base64.b64decode(coded[1])[8:])
    assert values == pytest.approx([-TILT], rel=1e-12)


STIFFENING = """
import numpy as np
from scipy.sparse import csc_array

from foundation import Winkler
from nmm.effects.given.steps import StepForce

WAY = 0.05


class Stiffening(Winkler):
    def force(self, state, end):
        u = self._way(state)
        return -np.asarray(self._rows(state).T @ (self._stiffness * u * (1 + (u / WAY) ** 2)))

    def matrix(self, state):
        slope = self._stiffness * (1 + 3 * (self._way(state) / WAY) ** 2)
        rows = self._rows(state)
        return csc_array(rows.T @ rows.multiply(slope[:, None]))

    def step_force(self, before, after, span):
        return StepForce(self.force(after, None), lambda: self.matrix(after))

    def energy(self, state):
        u = self._way(state)
        return float(self._stiffness @ (u**2 / 2 + u**4 / 4 / WAY**2))
"""


def test_work_of_loads_on_a_spring_that_stiffens_is_as_good_as_its_increments(
    tmp_path, monkeypatch
):
    (tmp_path / "stiffening.py").write_text(STIFFENING)
    for folder in (RAFT.parent, tmp_path):
        monkeypatch.syspath_prepend(str(folder))
    text = RAFT.read_text().replace("foundation:Winkler", "stiffening:Stiffening", 1)
    text = text.replace("point = [2.5, 1.0]", "point = [2.0, 1.0]")
    lacking = []
    for parts in (10, 20):
        scene = nmm.parse_scene(
            text + f"[loading]\nuntil = 1\n[formulation.loading]\nincrement = {1 / parts}\n"
        )
        done = nmm.run(scene, allow_code=["stiffening", "foundation", "steepness"])
        lacking.append(done.summary.audits["work_not_stored"])
        (said,) = [one for one in done.summary.warnings if "work_not_stored" in one]
        assert "the force of effects.ground is no line" in said
        settlement = done.history["ground:settlement"][-1]
        # k L u (1 + (u / WAY)^2) is the load.
        assert settlement * (1 + (settlement / 0.05) ** 2) == pytest.approx(SINKS, rel=1e-4)
    # The means of the loads at both ends are a rule of order two.
    assert lacking[0] / lacking[1] == pytest.approx(4, rel=0.05)


def test_what_a_scene_does_not_name_is_not_imported(monkeypatch):
    tables = tomllib.loads(RAFT.read_text())
    del tables["effects"], tables["output"]
    hold = {"name": "held", "segment": [[0, 0], [4, 0]], "fix": ["x", "y"]}
    imported = set(sys.modules) - {"foundation"}
    monkeypatch.delitem(sys.modules, "foundation", raising=False)
    assert nmm.run(build_scene({**tables, "supports": [hold]}), allow_code=CODE).frames
    assert "foundation" not in set(sys.modules) - imported


FAULTS = {
    'stiffness = "10 MPa/m"': ('stiffness = "10 MPa"', 'stiffness: "10 MPa": expected'),
    "segment = [[0, 0], [4, 0]]\nstiffness = \"10": (
        "segmnt = [[0, 0], [4, 0]]\nstiffness = \"10", 'segmnt": expected a known key'
    ),
    'type = "foundation:Winkler"\nsegment': (
        'type = "foundation:Winkle"\nsegment', "a subclass of nmm.effects.base.Effect"
    ),
    '"von_mises"': ('"von_mise"', 'did you mean "von_mises"?'),
    "segment = [[0, 0], [4, 0]]": ("segment = [[0, 5], [4, 5]]", "move the segment"),
}  # fmt: skip


@pytest.mark.parametrize("right", FAULTS)
def test_faults_in_tables_of_ones_own_are_told_by_line(right, tmp_path):
    wrong, message = FAULTS[right]
    text = RAFT.read_text().replace(right, wrong, 1)
    place = tmp_path / "raft.toml"
    place.write_text(text)
    with (
        nmm.trust.allowing(*CODE, folder=RAFT.parent),
        pytest.raises(nmm.NmmError, match=re.escape(message)) as caught,
    ):
        nmm.run(nmm.read_scene(place), allow_code=CODE)
    line = next(n for n, one in enumerate(text.splitlines(), 1) if wrong.split("\n")[0] in one)
    if "move" not in message:  # a place is told by the effect itself, which knows no lines
        assert f"{place}:{line}:" in str(caught.value)


def test_an_effect_of_ones_own_needs_the_users_word():
    with pytest.raises(nmm.NmmError, match=r"raft\.toml:\d+: effects\.ground.*--allow-code found"):
        nmm.run(nmm.read_scene(RAFT), allow_code=["steepness"])


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("gravity", "[gravity]"),
        ("body loads", '[[loads]] of kind "body"'),
        ("artificial joints", "[formulation.glue]"),
    ],
)
def test_a_builtin_effect_has_no_table_of_ones_own(name, key):
    text = RAFT.read_text().replace('"foundation:Winkler"', f'"{name}"', 1)
    told = f"built-in effects have tables of their own: write {key}"
    with pytest.raises(nmm.NmmError, match=re.escape(told)):
        nmm.run(nmm.parse_scene(text), allow_code=CODE)


@pytest.mark.parametrize(
    ("name", "known"),
    [
        ("ground:settlement", True),
        ("max:ground:reaction", True),
        ("energy:friction", True),
        ("grund:settlement", False),
        ("energy:grund", False),
        ("settlement", False),
    ],
)
def test_columns_of_an_effect_may_be_asked_for_before_a_run(name, known):
    scene = nmm.parse_scene(RAFT.read_text().partition("[output]")[0])
    if known:
        check_quantity_name(scene, name)
        return
    with pytest.raises(nmm.NmmError, match=name):
        check_quantity_name(scene, name)


def test_columns_of_an_output_of_ones_own_are_those_that_it_gives(done):
    check_quantity_name(nmm.read_scene(RAFT), "largest_tilt")
    assert quantity(done, "largest_tilt") == pytest.approx(TILT, rel=1e-12)
    with pytest.raises(nmm.NmmError, match=r"largest_tlt: expected .*largest_tilt"):
        quantity(done, "largest_tlt")


def test_quantities_of_ones_own_are_drawn_by_name(done):
    from nmm import plots

    axes = plots.stress(done, "ground:pressure")
    (bar,) = [one for one in axes.figure.axes if one is not axes]
    assert bar.get_ylabel() == "ground pressure  (kPa)"
    drawn = np.ma.getdata(axes.collections[0].get_array())
    assert drawn == pytest.approx([LOAD / LENGTH / 1e3], rel=1e-12)
    with pytest.raises(nmm.NmmError, match="minor, ground:pressure, friction:pressure, von_mises"):
        plots.stress(done, "pressure")


def test_places_in_tables_of_ones_own_move_with_a_scene_that_lies_far_away(done):
    def far(match):
        return f"[{float(match[1]) + 2.0**22}, {match[2]}]"

    places = r"(?<!direction = )\[(\d[\d.]*), (\d[\d.]*)\]"
    text = re.sub(places, far, RAFT.read_text())
    moved = nmm.run(nmm.parse_scene(text, str(RAFT)), allow_code=CODE)
    assert moved.origin.any()
    for name in ("ground:settlement", "largest_tilt", "energy:ground"):
        assert moved.history[name][-1] == pytest.approx(done.history[name][-1], rel=1e-12)


DROPPED = """
duration = "20 ms"
[inertia]
[formulation.integrator]
type = "newmark"
step = "0.2 ms"
[formulation.cover]
{cover}
"""


@pytest.mark.parametrize("cover", ["type = 'block'", "type = 'triangles'\nsize = 1.0\ndegree = 1"])
def test_a_body_that_bounces_on_springs_of_ones_own_keeps_its_energy(cover):
    tables = tomllib.loads(RAFT.read_text())
    tables |= tomllib.loads(DROPPED.format(cover=cover))
    tables["materials"]["concrete"]["density"] = 2400.0
    del tables["loads"]
    tables["initial_velocities"] = [
        {"block": "raft", "velocity": [0.1, -0.5], "angular_velocity": 0.02}
    ]
    run = nmm.run(build_scene(tables, str(RAFT)), allow_code=CODE)
    total = sum(
        run.history[name]
        for name in ("kinetic_energy", "strain_energy", "energy:ground", "energy:friction")
    )
    # Newmark's mean acceleration keeps quadratic energies; bodies turn by 1e-3 here, and axes that
    # turn with them within a step cost its square.
    assert total == pytest.approx(total[0], rel=1e-5)
    assert np.ptp(run.history["energy:ground"]) > 0.1 * total[0]
    # What is missing the first step took, which knows no forces at its start: (omega dt)^2 of it.
    lost = run.history["integration_loss"][-1] / (total[0] + run.history["integration_loss"][0])
    assert run.summary.energy_balance == pytest.approx(lost, abs=1e-6)
    assert run.summary.status == "converged"  # springs to the ground change the momentum


def test_springs_of_ones_own_follow_a_change_of_cover(done):
    stages = """
[[stages]]
name = "coarse"
[[stages]]
name = "fine"
cover = { size = 0.5, degree = 2 }
[formulation.cover]
type = "triangles"
size = 1.0
degree = 1
"""
    text = RAFT.read_text() + stages
    run = nmm.run(nmm.parse_scene(text, str(RAFT)), allow_code=CODE)
    assert run.summary.status == "converged"
    np.testing.assert_allclose(run.history["ground:reaction"], LOAD, rtol=1e-9)
    # The raft bends by less than a hundredth of what it tilts.
    np.testing.assert_allclose(run.history["largest_tilt"], TILT, rtol=0.01)
    # Cells of half the size, many cut by the edges of the raft.
    first, last = (len(run.frames[i].fields["von_mises"].values) for i in (0, -1))
    assert last > 2 * first


def test_an_installed_package_offers_an_effect_by_name(done, monkeypatch):
    def offered(group):
        entry = EntryPoint("winkler", "foundation:Winkler", group)
        return [entry] if group == "nmm.effect" else []

    monkeypatch.setattr(metadata, "entry_points", offered)
    monkeypatch.syspath_prepend(str(RAFT.parent))
    text = RAFT.read_text().replace("foundation:Winkler", "winkler")
    run = nmm.run(nmm.parse_scene(text.replace(', "steepness:Tilt"', "")))
    assert np.array_equal(run.history["energy:ground"], done.history["energy:ground"])


def test_the_effect_of_the_example_keeps_what_every_one_promises():
    for name in ("ground", "friction"):
        check_effect_of(nmm.read_scene(RAFT), name, allow_code=CODE)
    elsewhere = shifted(tomllib.loads(RAFT.read_text().replace('"-1 MN"', "-1e6")), (1e3, 2e3))
    moved = build_scene(elsewhere, str(RAFT))
    check_moved_effect(nmm.read_scene(RAFT), moved, "ground", allow_code=CODE)


def test_quantities_of_contacts_are_stored_and_in_paraview(tmp_path):
    from nmm.testing.outputs import TWO_BLOCKS

    bond = "bonded = true\ncohesion = 1e3\ntensile_strength = 1e3\nfriction_angle"
    text = (
        TWO_BLOCKS.replace("friction_angle", bond)
        + '[output]\nquantities = ["crack_opening", "principal_stress"]\n'
    )
    run = nmm.run(nmm.parse_scene(text), out=tmp_path / "run")
    stored = read_run(run.folder)
    opening = stored.frames[-1].fields["crack_opening"]
    assert (opening.on, opening.unit) == ("contacts", "m")
    assert len(opening.values) == len(stored.frames[-1].contact_gap) > 0
    assert not opening.values.any()  # all bonds hold
    write_paraview(stored, tmp_path / "files")
    contacts = sorted((tmp_path / "files").glob("contacts_*.vtu"))[-1].read_text()
    assert 'Name="crack_opening"' in contacts
    blocks = sorted((tmp_path / "files").glob("blocks_*.vtu"))[-1].read_text()
    assert re.search(r'Name="principal_stress"[^>]*ComponentName0="major"', blocks)


def test_explain_names_effects_of_ones_own():
    words = ["explain", str(RAFT), "--allow-code", "foundation", "--allow-code", "steepness"]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    assert "[effects.ground]: foundation:Winkler" in result.output
    assert CliRunner().invoke(app, words[:2]).exit_code == 1
