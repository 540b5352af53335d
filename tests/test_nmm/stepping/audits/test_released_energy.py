"""Energy that bonds free as they break in statics is told; rounding of nothing is no balance."""

from types import SimpleNamespace

import numpy as np
import pytest

import nmm
from nmm.stepping.audits.energy import balance
from nmm.stepping.reports.ledger import Ledger
from nmm.verification import text

DRIVEN = (
    '[[supports]]\nname = "left"\nsegment = [[0, 0], [0, 1]]\nfix = ["x", "y"]\n'
    '[[supports]]\nname = "right"\nsegment = [[2, 0], [2, 1]]\nfix = ["x", "y"]\n'
    "displacement = [4e-3, 0]\n"
)
GROWING = '[loading]\nuntil = "failure"\nmaximum_factor = 1.0\n'


def torn(law="", loading="", increment=0.1):
    """Two squares of 1 m and 1 GPa are pulled apart; their joint bears 100 kPa."""
    joint = '[interfaces.joint]\nfriction_angle = "30 deg"\nbonded = true\ncohesion = 1e6\n'
    tables = [
        text.material("rock", 1e9, 0.0),
        f"{joint}tensile_strength = 1e5\n{law}",
        text.box("a", (0, 0), (1, 1)),
        text.box("b", (1, 0), (1, 1)),
        DRIVEN,
        loading,
    ]
    scene = nmm.parse_scene(text.scene('plane = "strain"\n[contact]\n', tables))
    return nmm.run(scene, nmm.Formulation.model_validate({"loading": {"increment": increment}}))


def test_what_a_brittle_bond_frees_in_statics_is_told():
    summary = torn(loading=GROWING).summary
    (told,) = (one for one in summary.warnings if "audit energy_released" in one)
    # sigma^2 V / 2 E = (100 kPa)^2 2 m^3 / 2 GPa, and what its spring held: 10 J, all of the work.
    assert float(told.split(" J")[0]) == pytest.approx(10.0, rel=0.01)
    assert summary.energy_balance == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("increment", [1.0, 0.1, 0.01])
def test_what_a_softening_bond_takes_is_work_and_no_energy_released(increment):
    law = 'law = "linear_softening"\nfracture_energy = 100.0\n'
    run = torn(law, GROWING, increment)
    # All of the fracture energy of 1 m2, whether the peak lies within an increment or not; the
    # springs that take over from terms hold 5e-4 J.
    assert run.history["external_work"][-1] == pytest.approx(100.0, rel=1e-4)
    assert abs(run.summary.energy_balance) < 1e-4
    assert list(run.summary.warnings) == []


@pytest.mark.parametrize(("work", "lacking"), [(1e-30, 0.0), (1e-12, 1.0)])
def test_energies_of_nothing_but_rounding_are_in_balance(work, lacking):
    # A strain of 2e-16 in 1 m3 of 1 GPa holds 2.5e-23 J: what coordinates of 1 m may be off by.
    model = SimpleNamespace(modulus=np.array([1e9]), thickness=1.0)
    stepper = SimpleNamespace(model=model, size=1.0, plan=SimpleNamespace(contact=object()))
    assert balance(stepper, Ledger(work=work, throughput=work)) == lacking


@pytest.mark.parametrize("increment", [1.0, 0.5, 0.03])
def test_a_softening_bond_takes_its_fracture_energy_whatever_the_increment(increment):
    law = 'law = "linear_softening"\nfracture_energy = 100.0\n'
    run = torn(law, GROWING, increment)
    # What the springs that take over unload by: (100 kPa)^2 / 2 over 1e4 penalties of 1 GPa / m.
    assert run.history["friction_loss"][-1] == pytest.approx(100.0, rel=1e-5)


SHEARED = """
plane = "stress"
[contact]
[interfaces.any]
between = "any"
law = "linear_softening"
friction_angle = 0.5
cohesion = 2e5
tensile_strength = 2e5
fracture_energy = 100
bonded = true
[[supports]]
name = "floor"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[supports]]
name = "head"
segment = [[0, 2], [1, 2]]
fix = ["x", "y"]
displacement = [5e-3, 2e-4]
[[stages]]
name = "rest"
supports = ["floor"]
[[stages]]
name = "drive"
supports = ["floor", "head"]
"""


def sheared():
    """Two squares on cells whose bond is sheared off in the one increment of a stage."""
    tables = [
        text.material("rock", 1e9, 0.0),
        text.box("lower", (0, 0), (1, 1)),
        text.box("upper", (0, 1), (1, 1)),
    ]
    cover = {"type": "quads", "size": 0.5, "degree": 1}
    scene = nmm.parse_scene(text.scene(SHEARED, tables))
    return nmm.run(scene, nmm.Formulation.model_validate({"cover": cover}))


def test_a_bond_that_is_sheared_off_in_one_increment_takes_energy_and_gives_none():
    run = sheared()
    # What opens and what slides it take 100 J each at most, all of the slip under no pressure.
    assert 100.0 < run.history["friction_loss"][-1] < 200.0
    # Work is of forces at both ends of the increment, between which the bond bore all it did.
    assert ["energy_released" in one for one in run.summary.warnings] == [True]


def test_a_loss_below_nothing_is_told(monkeypatch):
    path = "nmm.contact.laws.losses.ContactLosses.energy"
    monkeypatch.setattr(path, lambda self, static: -1e3 * len(self.start))
    run = sheared()
    assert run.summary.status == "unbalanced"
    assert any("audit energy_made_by_friction" in one for one in run.summary.warnings)


def test_a_gap_that_closes_within_an_increment_is_told():
    """Two bars of 1 GN/m, 0.1 mm apart: one is pulled against the other by 1 MN at once.

    ``F = k u + k (u - g)`` moves it by 0.55 mm; 252.5 J are stored, and the mean load does 275 J.
    """
    held = '[[supports]]\nname = "{}"\nsegment = [[{}, 0], [{}, 1]]\nfix = ["x", "y"]\n'
    tables = [
        text.material("rock", 1e9, 0.0),
        text.interface("face", 0.0),
        text.box("a", (0, 0), (1, 1)),
        text.box("b", (1.0001, 0), (1, 1)),
        held.format("one", 0, 0),
        held.format("two", 2.0001, 2.0001),
        '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[1, 0], [1, 1]]\n'
        "traction = [1e6, 0]\n",
        '[formulation.contact]\nenforcement = "lagrange"\n',
    ]
    summary = nmm.run(nmm.parse_scene(text.scene('plane = "stress"\n[contact]\n', tables))).summary
    (told,) = (one for one in summary.warnings if "audit energy_released" in one)
    # Springs of supports are a millionth as soft, and bars turn by nothing.
    assert float(told.split(" J")[0]) == pytest.approx(22.5, rel=1e-2)
    assert "smaller increments" in told
