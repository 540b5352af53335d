"""Audits: what makes them speak, that quiet runs are quiet, and that the page has the table."""

from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.errors import SolveError
from nmm.stepping.audits import judge
from nmm.stepping.audits.base import AuditFinding
from nmm.stepping.audits.judge import judged
from nmm.stepping.audits.table import THRESHOLDS
from nmm.stepping.drive.verdict import CONVERGED, FAILED, UNBALANCED, RunVerdict
from nmm.stepping.reports.ledger import Ledger
from nmm.verification import text

ROOT = Path(__file__).parents[4]

DROP = text.scene(
    'plane = "stress"\nduration = 0.5\n[contact]\n[inertia]\n[gravity]\n',
    [
        text.material("a", 1e7, 0.0, 2000.0),
        text.interface("any", 0.0),
        text.box("floor", (-1, -1), (3, 1), "a"),
        text.box("b", (0, 0.2), (1, 1), "a"),
        text.fixed_block("floor"),
    ],
)
FREE = """
plane = "stress"
duration = 0.1
[inertia]
[materials.a]
young_modulus = 1e7
poisson_ratio = 0.0
density = 2000.0
[[blocks]]
name = "b"
material = "a"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[initial_velocities]]
block = "b"
velocity = [3.0, 4.0]
angular_velocity = 2.0
"""


def run(scene, **formulation):
    return nmm.run(nmm.parse_scene(scene), nmm.Formulation.model_validate(formulation)).summary


def test_a_free_block_that_turns_has_nothing_to_say():
    found = run(FREE, integrator={"type": "newmark", "step": 1e-3})
    assert (found.status, list(found.warnings)) == ("converged", [])
    assert {"momentum", "angular_momentum", "energy_made_in_run"} <= set(found.audits)


def test_an_audit_that_cannot_be_made_loses_no_run_and_is_told(monkeypatch):
    def cut_short(ended):
        yield AuditFinding("momentum", 0.0, "", "")
        raise SolveError("bar b: no stable slips")

    monkeypatch.setattr(judge, "AUDITS", (cut_short,))
    found = run(FREE, integrator={"type": "newmark", "step": 1e-3})
    assert found.status == "unbalanced"
    assert "cut short ended at the last state: bar b: no stable slips" in " ".join(found.warnings)
    assert set(found.audits) == {"momentum", "not_audited"}


@pytest.mark.parametrize("pull", [0.099, 0.2])
def test_strains_beyond_a_tenth_are_told_with_block_and_place(pull):
    """A strip of 1 MPa without Poisson's ratio is strained by its traction in MPa."""
    tables = [
        text.material("rubber", 1e6, 0.0),
        text.interface("any", 0.0),
        text.box("strip", (0, 0), (2, 1), "rubber"),
        '[[supports]]\nname = "left"\nsegment = [[0, 0], [0, 1]]\nfix = ["x", "y"]\n',
        '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[2, 0], [2, 1]]\n'
        f"traction = [{pull * 1e6}, 0]\n",
    ]
    found = run(text.scene('plane = "stress"\n[contact]\n', tables))
    assert found.audits["large_strain"] == pytest.approx(pull, rel=1e-9)
    told = [f"block strip is strained by {100 * pull:.3g} % about (1, 0.5) m"] * (pull > 0.1)
    assert [warning.split(";")[0] for warning in found.warnings] == told


@pytest.mark.parametrize("peak", [0.099, 0.2])
def test_strains_beyond_a_tenth_of_what_spins_are_told_without_contact(peak):
    """A square that is spun swells by ``rho omega^2 a^2 / (6 E)``, within half a swing."""
    spin, density = 20.0, 2000.0
    modulus, swing = density * spin**2 / (6 * peak), np.sqrt(2 * spin**2 / peak)
    scene = (
        FREE.replace("young_modulus = 1e7", f"young_modulus = {modulus!r}")
        .replace("angular_velocity = 2.0", f"angular_velocity = {spin!r}")
        .replace("duration = 0.1", f"duration = {float(np.pi / swing)!r}")
    )
    found = run(scene, integrator={"type": "newmark", "step": 2e-4})
    assert found.audits["large_strain"] == pytest.approx(peak, rel=1e-4)  # of the steps
    told = any("large_strain" in one and "finite" in one for one in found.warnings)
    assert told == (peak > 0.1)


def test_energy_that_a_coarse_step_loses_is_told_with_a_step_that_keeps_it():
    # Soft springs, so that the steps that resolve them are not too many.
    shorter, contact = DROP.replace("0.5\n", "0.3\n"), {"normal_penalty": 0.5}
    coarse = run(shorter, contact=contact, integrator={"type": "shi", "step": 5e-3})
    (warning,) = [one for one in coarse.warnings if "energy_lost" in one]
    step = float(warning.split("steps of some ")[1].split(" s")[0])
    assert step < 5e-3
    kept = run(shorter, contact=contact, integrator={"type": "shi", "step": step})
    # An estimate: it is stated as one.
    assert kept.audits["energy_lost"] < 1.5 * THRESHOLDS["energy_lost"].warns


def test_an_impact_shorter_than_its_steps_is_told():
    found = run(DROP, integrator={"type": "newmark", "step": 1e-2})
    assert any("contact_duration" in one for one in found.warnings)
    assert found.status == "converged"


def test_soft_springs_of_contact_are_told_by_the_overlap():
    found = run(DROP, contact={"normal_penalty": 0.02}, integrator={"step": 1e-3})
    told = next(one for one in found.warnings if "audit penetration" in one)
    # Which bodies, how deep and when: what is to be looked at.
    assert " and " in told
    assert " s; raise" in told


@pytest.mark.parametrize(("pressed", "area"), [("plate", 1.0), ("chip", 1e-6)])
def test_overlap_counts_in_the_size_of_the_smaller_of_both_bodies(pressed, area):
    # A chip of a millimetre on one floor, a plate of a metre on another, one of them pressed.
    side, at = np.sqrt(area), {"plate": 0.0, "chip": 3.0}[pressed]
    force, modulus, penalty = 1e4 * side, 1e6, 2.0
    tables = [
        text.material("a", modulus, 0.0),
        text.interface("any", 0.0),
        text.box("floor", (-1, -1), (5, 1), "a"),
        text.box("plate", (0, 0), (1, 1), "a"),
        text.box("chip", (3, 0), (1e-3, 1e-3), "a"),
        text.fixed_block("floor"),
        text.pulled_edge("press", [(at, side), (at + side, side)], (0, -force / side)),
    ]
    found = run(
        text.scene('plane = "stress"\n[contact]\n', tables), contact={"normal_penalty": penalty}
    )
    # Half the force on each of two springs of `normal_penalty` times Young's modulus (N/m).
    overlap = force / 2 / (penalty * modulus)
    assert found.audits["penetration"] == pytest.approx(overlap / side, rel=1e-3)


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
def test_a_joint_that_gives_is_told_by_its_own_stiffness(enforcement):
    soft = DROP.replace("friction_angle", "normal_stiffness = 5e6\nfriction_angle")
    found = run(soft, contact={"enforcement": enforcement}, integrator={"step": 1e-3})
    told = next(one for one in found.warnings if "audit penetration" in one)
    assert "normal_stiffness of its interface" in told
    assert "penalty" not in told
    assert "faces of meshes" not in told


def test_the_growth_of_the_linear_update_is_told():
    found = run(FREE.replace("velocity = 2.0", "velocity = 20.0"), rotation={"update": "linear"})
    # Each step of angle t grows the area by t^2: 100 steps of 0.02 rad make 4 %.
    assert found.audits["mass"] == pytest.approx(0.04, rel=0.1)
    assert any("audit mass" in one for one in found.warnings)


def test_a_failure_load_that_asks_for_too_much_is_not_hidden():
    finding = AuditFinding("failure_tolerance", 3.0, "known within 3 %", "lower the increment")
    assert finding.warns
    assert not finding.fails


@pytest.mark.parametrize("name", [name for name, row in THRESHOLDS.items() if row.fails])
@pytest.mark.parametrize("value", [2.0, np.nan])
def test_a_solved_run_whose_audit_fails_is_unbalanced(name, value):
    bound = THRESHOLDS[name].fails
    found = judged(
        RunVerdict(CONVERGED, "solved"), [AuditFinding(name, value * bound, "off", "do")]
    )
    assert found.code == UNBALANCED
    assert "off" in found.sentence
    quiet = judged(RunVerdict(CONVERGED, "solved"), [AuditFinding(name, 0.5 * bound, "off", "do")])
    assert quiet.code == CONVERGED
    failed = judged(RunVerdict(FAILED, "why"), [AuditFinding(name, value * bound, "off", "do")])
    assert failed.code == FAILED


def test_converged_with_energy_made_is_impossible():
    """Contact that makes energy: a spring that is loaded by nothing, as a ledger sees it."""
    ledger = Ledger(throughput=1.0, energies={"kinetic_energy": 1.16})
    ledger = ledger.weighed(time=0.0, audited=True)
    assert ledger.in_run.energy == pytest.approx(1.16)
    assert ledger.balance == pytest.approx(-1.0)


def test_every_threshold_warns_before_it_fails():
    for name, row in THRESHOLDS.items():
        assert row.fails is None or row.warns <= row.fails, name


def test_the_page_has_the_tables_of_the_code(script):
    page = script(ROOT / "docs/audit_page.py")
    written = page.PAGE.read_text()
    assert page.renewed(written) == written, "write it anew: python docs/audit_page.py"
    assert all(f"| `{name}` |" in written for name in THRESHOLDS)


@pytest.mark.parametrize(("friction", "told"), [(0.3, True), (0.0, False)])
def test_a_path_is_told_to_matter_where_what_slides_rubs(friction, told):
    """A block is pushed along a floor in four increments: nothing holds it by its way without."""
    scene = text.scene(
        'plane = "stress"\n[contact]\n[gravity]\n[loading]\nscaled = ["push"]\nuntil = 1.0\n'
        "[formulation.loading]\nincrement = 0.25\n",
        [
            text.material("a", 1e9, 0.0, 2000.0),
            text.interface("any", float(np.degrees(friction))),
            text.box("floor", (-1, -1), (5, 1), "a"),
            text.box("b", (0, 0), (1, 1), "a"),
            text.fixed_block("floor"),
            '[[supports]]\nname = "push"\nsegment = [[0, 0], [0, 1]]\nblock = "b"\nfix = ["x"]\n'
            "displacement = [0.01, 0]\n",
        ],
    )
    summary = nmm.run(nmm.parse_scene(scene)).summary
    assert summary.status == "converged"
    assert any("audit increments" in one for one in summary.warnings) is told
