"""What the audit of energy says of where energy came from: the part of the run that gave it."""

import re

import pytest

import nmm
from nmm.verification import text

BEND = "bodies bend too far"
HEAD = 'plane = "strain"\nduration = {}\n[inertia]\n'
SOFTENS = {
    "bonded": True,
    "tensile_strength": 3e4,
    "cohesion": 3e4,
    "fracture_energy": 45.0,
}


def moving(block, *velocity, spin=0.0):
    start = f'[[initial_velocities]]\nblock = "{block}"\nvelocity = {list(velocity)}\n'
    return start + f"angular_velocity = {spin!r}\n"


def pair(head, interface, *more):
    bodies = [text.box("a", (-1, 0), (1, 1)), text.box("b", (0, 0), (1, 1))]
    matter = text.material("rock", 1e8, 0.0, 2000.0)
    return text.scene(head, [matter, interface, *bodies, *more])


TORN = pair(
    HEAD.format(5e-3) + "[contact]\n",
    text.interface("bond", 20.0, more=SOFTENS),
    moving("a", -0.5, 0.0),
    moving("b", 0.5, 0.0),
)
GLUED = pair(
    HEAD.format(0.1),
    text.interface("glue", 20.0, more={"bonded": True}),
    moving("a", 0.0, -2.5, spin=5.0),
    moving("b", 0.0, 2.5, spin=5.0),
)
PENDULUM = text.scene(
    HEAD.format(0.1) + "[gravity]\n",
    [
        text.material("rock", 1e9),
        text.box("bar", (0, 0), (1, 0.2)),
        '[[supports]]\nname = "pin"\npoint = [0, 0.2]\nfix = ["x", "y"]\n',
    ],
)
WAVES = text.scene(
    HEAD.format(0.6) + "[damping]\nlocal = 0.5\n",
    [
        text.material("rock", 1e8),
        text.box("mass", (0, 0), (1, 1)),
        '[[springs]]\nname = "side"\npoints = [[-2, 0.5], [0, 0.5]]\nstiffness = 1e6\n'
        'blocks = ["ground", "mass"]\n',
        moving("mass", 2.0, 1.0, spin=1.0),
    ],
)


def told(scene, audit, integrator="newmark", step=1e-3, **formulation):
    table = {"integrator": {"type": integrator, "step": step}, **formulation}
    found = nmm.run(nmm.parse_scene(scene), nmm.Formulation.model_validate(table)).summary
    (one,) = (line for line in found.warnings if audit in line)
    return one


@pytest.mark.parametrize("bonds", ["nitsche", "spring"])
@pytest.mark.parametrize("audit", ["energy_made_in_step", "energy_made_in_run"])
def test_bonds_that_tear_within_few_steps_are_named(audit, bonds):
    said = told(TORN, audit, contact={"bonds": bonds})
    assert "bonds that soften" in said
    assert BEND not in said


@pytest.mark.parametrize(("scene", "names"), [(PENDULUM, "supports"), (GLUED, "bonded interfaces")])
def test_what_holds_bodies_that_turn_is_named(scene, names):
    said = told(scene, "energy_made_in_step", step=5e-3)
    assert f"springs of {names}" in said
    assert BEND not in said


def test_what_is_advised_for_a_pin_keeps_the_energy_of_a_pendulum():
    table = {"integrator": {"type": "newmark", "step": 5e-3}, "rotation": {"update": "finite"}}
    found = nmm.run(nmm.parse_scene(PENDULUM), nmm.Formulation.model_validate(table)).summary
    assert "[rotation] update" in told(PENDULUM, "energy_made_in_step", step=5e-3)
    assert found.audits["energy_made_in_run"] < 1e-4  # its threshold


def test_an_integrator_that_gives_for_a_moment_is_named_though_it_takes_more_in_all():
    said = told(WAVES, "energy_made_in_step", "generalized_alpha", 1e-2)
    assert 'the integrator "generalized_alpha"' in said
    assert BEND not in said


def test_springs_of_contact_have_not_lost_what_they_stored_in_the_first_step():
    bodies = [*text.floor(), text.box("b", (0, 0), (1, 1)), moving("b", 0.0, -0.1)]
    scene = text.scene(HEAD.format(0.014) + "[contact]\n", [text.material("rock", 1e7), *bodies])
    table = {"integrator": {"step": 7e-3}, "contact": {"normal_penalty": 1.0}}
    found = nmm.run(nmm.parse_scene(scene), nmm.Formulation.model_validate(table)).summary
    # All that is lost is the springs', which push through a step as at its end.
    (said,) = (line for line in found.warnings if "energy_lost" in line)
    lost = sum(float(part) for part in re.findall(r"([0-9.]+) % by", said))
    assert lost == pytest.approx(100 * found.energy_balance, rel=5e-3)  # three digits are told


@pytest.mark.parametrize("enforcement", ["cone", "lagrange"])
def test_an_impact_that_bodies_stay_together_after_asks_for_no_shorter_steps(enforcement):
    """A square that hits one like it, at rest: half of its energy goes, whatever the step."""
    two = [text.box("a", (0, 0), (1, 1)), text.box("b", (1.001, 0), (1, 1))]
    tables = [text.material("rock", 1e9), text.interface("dry", 0.0), *two, moving("a", 0.1, 0.0)]
    scene = text.scene(HEAD.format(0.04) + "[contact]\n", tables)
    said = told(scene, "energy_lost", step=4e-3, contact={"enforcement": enforcement})
    assert "steps of some" not in said
    assert "stay together" in said


def test_an_integrator_has_not_lost_what_dashpots_took():
    damped = WAVES.replace("[damping]\nlocal = 0.5\n", "") + (
        '[[dashpots]]\nname = "damper"\npoints = [[3, 0.5], [1, 0.5]]\nviscosity = 2e4\n'
        'blocks = ["ground", "mass"]\n'
    )
    table = {"integrator": {"type": "shi", "step": 1e-2}}
    found = nmm.run(nmm.parse_scene(damped), nmm.Formulation.model_validate(table)).summary
    (said,) = (line for line in found.warnings if "energy_lost" in line)
    (lost,) = re.findall(r"([0-9.]+) % by", said)
    assert float(lost) == pytest.approx(100 * found.energy_balance, rel=5e-3)  # three digits
