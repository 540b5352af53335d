"""Bars with bond and without against shear lag, pull-out and balance of forces."""

import numpy as np
import pytest

import nmm
from nmm.testing import check_effect_of

SECTION, AROUND = np.pi * 0.016**2 / 4, np.pi * 0.016
EA = 200e9 * SECTION
PULL = """
plane = "stress"
[materials.rock]
young_modulus = "{modulus}"
poisson_ratio = 0.0
[[blocks]]
name = "host"
material = "rock"
vertices = [[0, -0.1], [{length}, -0.1], [{length}, 0.1], [0, 0.1]]
[[blocks]]
name = "jack"
material = "rock"
vertices = [[{length}, -0.1], [{end}, -0.1], [{end}, 0.1], [{length}, 0.1]]
[[bars]]
name = "bar"
points = [[0, 0], [{length}, 0]]
blocks = ["host", "jack"]
diameter = "16 mm"
young_modulus = "200 GPa"
ends = ["free", "fixed"]
{bar}
[bars.bond]
{bond}
[[supports]]
name = "wall"
block = "host"
segment = [[0, -0.1], [0, 0.1]]
fix = ["x", "y"]
[[supports]]
name = "jack"
block = "jack"
segment = [[{end}, -0.1], [{end}, 0.1]]
fix = ["x", "y"]
displacement = [{way}, 0]
[loading]
[formulation.loading]
increment = {increment}
[formulation.bars]
pieces = {pieces}
{more}
"""
ELASTIC = 'law = "linear"\nstiffness = "10 GPa/m"'
BILINEAR = 'law = "bilinear"\nstrength = "8 MPa"\nslips = ["0.1 mm", "1 mm"]'


def pull(bond, way, length=0.3, increment=1.0, pieces=40, modulus="1e6 GPa", bar="", more=""):
    """Run of a bar pulled out of a host by a jack at its end."""
    text = PULL.format(
        length=length,
        end=length + 0.1,
        bond=bond,
        way=way,
        increment=increment,
        pieces=pieces,
        modulus=modulus,
        bar=bar,
        more=more,
    )
    return nmm.run(nmm.parse_scene(text))


@pytest.mark.parametrize("turned", [False, True])
def test_a_bar_with_elastic_bond_follows_shear_lag(turned):
    more = '[formulation.cover]\ntype = "triangles"\nsize = 0.11\nangle = 0.3\n' * turned
    found = pull(ELASTIC, 4.474853334e-4, pieces=20, more=more)
    # 50 kN at a loaded slip of 0.4474853 mm: F coth(beta L) / (E A beta), Volkersen (1938). The
    # scheme is of order 2 in beta times a piece, 0.053; the host gives way by 1e-5 of it.
    assert found.history["bars:bar:force"][-1] == pytest.approx(50e3, rel=5e-4)
    assert found.history["reaction:wall:x"][-1] == pytest.approx(-50e3, rel=5e-4)
    assert abs(found.summary.energy_balance) < 1e-4


def test_the_error_of_shear_lag_falls_with_the_square_of_a_piece():
    errors = [
        abs(
            pull(ELASTIC, 4.474853334e-4, pieces=n, modulus="1e9 GPa").history["bars:bar:force"][-1]
            - 50e3
        )
        for n in (10, 20)
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def test_the_peak_of_a_bilinear_bond_is_that_of_the_two_zone_solution():
    found = pull(BILINEAR, 0.6e-3, increment=1 / 60)
    slip, force = 0.6e-3 * found.history["load_factor"], found.history["bars:bar:force"]
    # Yuan, Teng, Seracino, Wu and Yao (2004): 101.838310 kN at 0.503584 mm, not pi d L tau = 120.6.
    assert force.max() == pytest.approx(101838.31, rel=1e-3)
    assert slip[force.argmax()] == pytest.approx(0.503584e-3, abs=1e-5)  # one increment
    assert np.interp(0.25e-3, slip, force) == pytest.approx(77087.065, rel=2e-3)
    assert abs(found.summary.energy_balance) < 1e-3


def test_a_long_softening_bond_that_snaps_back_is_told_by_the_bar_s_name():
    found = pull(BILINEAR, 3e-3, length=1.0, increment=0.02, pieces=60)
    assert found.summary.status != "converged"
    assert "bars bar" in found.summary.sentence
    assert "snap-back" in found.summary.sentence
    # The infinite bar: sqrt(2 Gf p E A).
    assert found.history["bars:bar:force"].max() == pytest.approx(127162.6, rel=2e-3)
    assert 3e-3 * found.history["load_factor"][-1] == pytest.approx(2.5925e-3, rel=0.02)


def test_ever_stiffer_bonds_tend_to_the_rigid_one_without_locking():
    cover = '[formulation.cover]\ntype = "quads"\nsize = 0.1\ndegree = 2\n'
    stiff = [10.0**power for power in (7, 10, 13, 16, 19)]
    runs = [
        pull(f'law = "linear"\nstiffness = {k}', 1e-4, modulus="30 GPa", more=cover) for k in stiff
    ]
    force = [run.history["bars:bar:force"][-1] for run in runs]
    slip = [abs(run.history["bars:bar:slip"][-1]) for run in runs]
    assert (np.diff(force) > 0).all()
    assert force[-1] / force[-2] == pytest.approx(1, abs=2e-3)
    assert slip[-1] / slip[-2] == pytest.approx(1e-3, rel=0.01)


def test_a_bar_yields_at_its_yield_stress():
    found = pull(ELASTIC, 2e-3, increment=0.1, bar='yield_stress = "500 MPa"')
    assert found.history["bars:bar:force"][-1] == pytest.approx(500e6 * SECTION, rel=1e-9)
    assert found.history["loss:bars"][-1] > 0
    assert abs(found.summary.energy_balance) < 1e-2


GROUTED = """
plane = "stress"
[materials.rock]
young_modulus = "1e6 GPa"
poisson_ratio = 0.0
[[blocks]]
name = "left"
material = "rock"
vertices = [[-1.5, -0.5], [0, -0.5], [0, 0.5], [-1.5, 0.5]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[0, -0.5], [1.5, -0.5], [1.5, 0.5], [0, 0.5]]
[[bars]]
name = "bolt"
points = [[-1.5, 0], [1.5, 0]]
diameter = "25 mm"
young_modulus = "200 GPa"
[bars.bond]
stiffness = "5 GPa/m"
[[supports]]
name = "left"
segment = [[-1.5, -0.5], [-1.5, 0.5]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[1.5, -0.5], [1.5, 0.5]]
fix = ["x", "y"]
displacement = ["0.5 mm", 0]
"""


def test_a_grouted_bar_resists_the_opening_of_a_joint():
    found = nmm.run(nmm.parse_scene(GROUTED))
    # T = E A beta tanh(beta L) w / 2, beta = 2 / m, both far ends free; pieces of 0.15 / beta are
    # softer by an eighth of its square.
    assert found.history["bars:bolt:force"][-1] == pytest.approx(48844.636, rel=4e-3)
    assert found.history["reaction:right:x"][-1] == pytest.approx(48844.636, rel=4e-3)


HUNG = """
plane = "stress"
[materials.rock]
young_modulus = "1e4 GPa"
poisson_ratio = 0.0
density = {density}
[interfaces.joint]
friction_angle = "30 deg"
[[blocks]]
name = "roof"
material = "rock"
vertices = [[0, 0], [4, 0], [4, 3], [0, 3]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[1, -1], [3, -1], [3, 0], [1, 0]]
{bolts}
[[supports]]
name = "roof"
segment = [[0, 3], [4, 3]]
fix = ["x", "y"]
[[monitors]]
name = "block"
point = [2, -1]
[gravity]
[contact]
"""
BOLT = """
[[bars]]
name = "{name}"
points = [[{x}, 3], [{x}, 0]]
blocks = ["roof", "block"]
diameter = "25 mm"
young_modulus = "200 GPa"
pretension = "{force} kN"
"""


@pytest.mark.parametrize(("force", "opening"), [(20, 0.305577e-3), (40, 0.0)])
def test_pretensioned_bolts_hold_a_block_under_a_roof(force, opening):
    bolts = "".join(BOLT.format(name=n, x=x, force=force) for n, x in (("a", 1.5), ("b", 2.5)))
    found = nmm.run(nmm.parse_scene(HUNG.format(density=30e3 / 9.81, bolts=bolts)))
    assert found.summary.status == "converged", found.summary.sentence
    # 60 kN on two bolts of E A / L = 32.724923 MN/m: 30 kN each where the joint opens.
    for name in "ab":
        held = found.history[f"bars:{name}:force"][-1]
        assert held == pytest.approx(max(force, 30) * 1e3, rel=1e-3)
    assert -found.history["monitor:block:uy"][-1] == pytest.approx(opening, abs=2e-6)


PLANE = """
plane = "stress"
[materials.rock]
young_modulus = "1000 GPa"
poisson_ratio = 0.0
density = 1000
[interfaces.joint]
friction_angle = "30 deg"
[[blocks]]
name = "base"
material = "rock"
vertices = [[-3, -3], [5, -3], [5, 0], [-3, 0]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[springs]]
name = "bolt"
points = [[0.5, 0.5], [{x}, {y}]]
blocks = ["block", "base"]
stiffness = "20 MN/m"
[[supports]]
name = "base"
segment = [[-3, -3], [5, -3]]
fix = ["x", "y"]
[[monitors]]
name = "block"
point = [1, 0]
block = "block"
[gravity]
acceleration = [{along}, {down}]
[contact]
"""


def test_a_bolt_across_a_plane_takes_what_friction_does_not():
    slope, bolt, weight = np.radians(40), np.radians(60), 100e3 / 2000
    text = PLANE.format(
        x=0.5 - 2 * np.cos(bolt),
        y=0.5 - 2 * np.sin(bolt),
        along=weight * np.sin(slope),
        down=-weight * np.cos(slope),
    )
    found = nmm.run(nmm.parse_scene(text))
    assert found.summary.status == "converged", found.summary.sentence
    # T = W (sin a - cos a tan phi) / (cos b + sin b tan phi); the bolt turns by 0.9 mrad.
    assert found.history["springs:bolt:force"][-1] == pytest.approx(20051.164, rel=5e-3)
    assert found.history["monitor:block:ux"][-1] == pytest.approx(2.00511644e-3, rel=5e-3)


@pytest.mark.parametrize("bond", [ELASTIC, BILINEAR])
def test_bars_keep_what_every_effect_promises(bond):
    text = PULL.format(
        length=0.3,
        end=0.4,
        bond=bond,
        way=0,
        increment=1,
        pieces=10,
        modulus="30 GPa",
        bar="",
        more="",
    )
    check_effect_of(nmm.parse_scene(text.replace("[loading]", "")), "bars")


SPINNING = """
plane = "strain"
duration = "0.5 s"
[materials.stone]
young_modulus = "5 GPa"
poisson_ratio = 0.2
density = 1000
[[blocks]]
name = "stone"
material = "stone"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[bars]]
name = "bar"
points = [[0.1, 0.2], [0.9, 0.7]]
diameter = "25 mm"
young_modulus = "200 GPa"
bond = { law = "bilinear", strength = "2 MPa", slips = ["0.1 mm", "2 mm"] }
[[initial_velocities]]
block = "stone"
velocity = [0.2, 1]
angular_velocity = 6
[inertia]
[formulation.bars]
pieces = 10
[formulation.integrator]
type = "newmark"
step = "10 ms"
"""


@pytest.mark.parametrize("cover", ["", '[formulation.cover]\ntype = "triangles"\nsize = 0.4\n'])
def test_a_bar_in_a_body_that_spins_feels_its_stretch_alone(cover):
    found = nmm.run(nmm.parse_scene(SPINNING + cover))
    assert found.summary.status == "converged", found.summary.sentence
    # Half a turn; a strain of rho w^2 r^2 / E, 2e-6 of a stone of 0.5 m, times E A = 98 MN.
    assert np.abs(found.history["bars:bar:force"]).max() < 200
    assert found.history["loss:bars"][-1] == 0
    assert found.summary.audits["momentum"] < 1e-10
    assert found.summary.audits["angular_momentum"] < 1e-10


TWO = """
plane = "strain"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
{blocks}
[[supports]]
name = "foot"
block = "low"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[supports]]
name = "head"
block = "high"
segment = [[0, 2], [1, 2]]
fix = ["x", "y"]
displacement = [0, 1e-3]
[[bars]]
name = "bar"
points = [[0.5, 0.3], [0.5, 1.7]]
diameter = "25 mm"
young_modulus = "200 GPa"
[bars.bond]
law = "linear"
stiffness = "10 GPa/m"
[formulation.bars]
pieces = 7
"""
BLOCK = (
    '[[blocks]]\nname = "{}"\nmaterial = "rock"\nvertices = [[0, {}], [1, {}], [1, {}], [0, {}]]\n'
)
LOW, HIGH = BLOCK.format("low", 0, 0, 1, 1), BLOCK.format("high", 1, 1, 2, 2)


def test_a_piece_whose_middle_is_on_a_joint_knows_no_order_of_blocks():
    """The fourth of seven pieces has its middle on it, a seventh of the bond."""
    found = [
        nmm.run(nmm.parse_scene(TWO.format(blocks=blocks))).history["bars:bar:force"][-1]
        for blocks in (LOW + HIGH, HIGH + LOW)
    ]
    assert found[0] > 1e3
    assert found[1] == pytest.approx(found[0], rel=1e-10)


HELD_AT_BOTH_ENDS = """
plane = "stress"
[materials.rock]
young_modulus = "1e6 GPa"
poisson_ratio = 0.0
[[blocks]]
name = "host"
material = "rock"
vertices = [[{x}, {y}], [{end}, {y}], [{end}, {top}], [{x}, {top}]]
[[bars]]
name = "bar"
points = [[{first}, {middle}], [{last}, {middle}]]
diameter = "16 mm"
young_modulus = "200 GPa"
[bars.bond]
law = "linear"
stiffness = "10 GPa/m"
[[supports]]
name = "left"
segment = [[{x}, {y}], [{x}, {top}]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[{end}, {y}], [{end}, {top}]]
fix = ["x", "y"]
displacement = [4e-5, 0]
[formulation.bars]
pieces = 41
"""


@pytest.mark.parametrize("x", [0.0, 1234.5, -0.37])
@pytest.mark.parametrize("way", [1, -1])
def test_of_slips_alike_at_both_ends_the_one_at_the_first_is_told_wherever_the_bar_lies(x, way):
    """Shear lag in a host of strain 1e-4: slips are -1e-4 sinh(a z) / (a cosh(a l / 2))."""
    first, last = [x + 0.05, x + 0.35][::way]
    across = {"y": x / 3, "middle": x / 3 + 0.1, "top": x / 3 + 0.2}
    text = HELD_AT_BOTH_ENDS.format(x=x, end=x + 0.4, first=first, last=last, **across)
    rate = np.sqrt(10e9 * AROUND / EA)
    middle = 0.15 * (1 - 1 / 41)  # of the first piece, from the bar's
    wanted = 1e-4 * np.sinh(rate * middle) / (rate * np.cosh(rate * 0.15))
    told = nmm.run(nmm.parse_scene(text)).history["bars:bar:slip"][-1]
    # Pieces of h = 7 mm: (a h)^2 = 7e-4.
    assert told == pytest.approx(wanted, rel=1e-3)


FREE_TO_THE_GROUND = """
plane = "stress"
[materials.rock]
young_modulus = "1e6 GPa"
poisson_ratio = 0.0
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "moved"
block = "block"
fix = ["x", "y"]
displacement = ["%s", 0]
[[bars]]
name = "bar"
points = [[1.5, 0.5], [-1, 0.5]]
blocks = ["block", "ground"]
area = "100 mm^2"
perimeter = "0.1 m"
young_modulus = "200 GPa"
yield_stress = "100 MPa"
ends = ["free", "ground"]
[bars.bond]
law = "plastic"
stiffness = "1 GPa/m"
strength = "%s kPa"
"""


@pytest.mark.parametrize("way", ["1 mm", "50 mm"])
@pytest.mark.parametrize(("strength", "force"), [(50, 7.5e3), (66, 9.9e3), (200, 1e4)])
def test_a_bar_is_pulled_out_in_one_increment_though_its_free_length_would_yield_first(
    way, strength, force
):
    found = nmm.run(nmm.parse_scene(FREE_TO_THE_GROUND % (way, strength)))
    assert found.summary.status == "converged", found.summary.sentence
    # 1.5 m of bond, 0.1 m around; the steel yields at 10 kN. Slips balance to 1e-13 of the forces.
    assert found.history["bars:bar:force"][-1] == pytest.approx(force, rel=1e-9)
