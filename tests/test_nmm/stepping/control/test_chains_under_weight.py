"""Chains of bonded blocks that hang and are pulled, event by event: loads and energies by hand."""

import pytest

import nmm
from nmm.errors import NmmError

STRENGTH, WEIGHT, WIDTH, PULL, MODULUS = 2.5e5, 2000 * 9.81, 0.5, 100.0, 1e10
EVENTS = '[loading]\nuntil = "failure"\n[loading.control]\ntype = "events"\nfall = 0.1\n'
STRESSED = '[[initial_stresses]]\nblock = "all"\nstress = [0, 2e4, 0]\n'
BONDS = {"terms": "", "springs": '[formulation.contact]\nbonds = "spring"\n'}


SOFTENS = 'law = "linear_softening"\nfracture_energy = 50.0\n'
LED = EVENTS.replace('"events"', '"dissipation"\nenergy = 1.0')


def chain(number: int, more: str, control: str = EVENTS, law: str = "") -> nmm.Run:
    """Return the run of so many blocks of half a square metre below a ceiling."""
    bricks = [
        f'[[blocks]]\nname = "b{n}"\nmaterial = "m"\n'
        f"vertices = [[0, {-n - 1}], [0.5, {-n - 1}], [0.5, {-n}], [0, {-n}]]\n"
        for n in range(number)
    ]
    return nmm.run(
        nmm.parse_scene(f"""plane = "stress"
            [materials.m]
            young_modulus = {MODULUS}
            poisson_ratio = 0.0
            density = 2000
            [interfaces.joint]
            bonded = true
            tensile_strength = {STRENGTH}
            cohesion = 1e9
            friction_angle = "30 deg"
            {law}{"".join(bricks)}
            [[supports]]
            name = "ceiling"
            segment = [[0, 0], [0.5, 0]]
            fix = ["x", "y"]
            [[loads]]
            name = "pull"
            kind = "edge"
            segment = [[0, {-number}], [0.5, {-number}]]
            traction = [0, {-PULL}]
            [gravity]
            [contact]
            {control}{more}""")
    )


@pytest.mark.parametrize("bonds", BONDS)
@pytest.mark.parametrize("stress", ["", STRESSED])
@pytest.mark.parametrize("number", [3, 10])
def test_the_highest_joint_breaks_and_nothing_is_lost_before(
    number: int, stress: str, bonds: str
) -> None:
    run = chain(number, stress + BONDS[bonds])
    # The joint below the first block carries all others and the pull.
    expected = (STRENGTH - WEIGHT * (number - 1)) / PULL
    assert run.summary.failure_factor == pytest.approx(expected, rel=1e-9)
    lost, work = (run.history[name][-1] for name in ("friction_loss", "external_work"))
    # Of what weight and pull do to a chain that is whole nothing is lost.
    assert abs(lost) < 1e-9 * abs(work)
    assert not run.summary.warnings


def test_dissipation_leads_no_path_beside_weight() -> None:
    """By (lambda f.du - dlambda f.u) / 2 unloading alone would take what weight has done."""
    with pytest.raises(NmmError, match="gravity act at a load factor of zero: what unloads does"):
        chain(3, "", LED, SOFTENS)
