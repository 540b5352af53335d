"""Bonds that consistent terms hold: no stiffness of their own, and no jump as they give way."""

from itertools import pairwise

import numpy as np
import pytest

import nmm
from nmm.contact.bonds.turning import counted
from nmm.errors import NmmError
from nmm.scene import parse_scene
from nmm.verification import text

STRENGTH = 3e6
RESIDUAL = 1e-6  # of the steps


def bar(*, more="", law="", head="", lengths=(0.5, 2.0), moduli=(1e9, 10e9), cohesion=1e9):
    """Blocks of 1 m x 1 m2 in a row, bonded and held at their left end."""
    joint = {"cohesion": cohesion, "tensile_strength": STRENGTH, "bonded": True}
    ends = np.concatenate([[0.0], np.cumsum(lengths)])
    names = [f"m{number}" for number in range(len(lengths))]
    blocks = [
        text.block(f"b{number}", name, text.rectangle((a, 0), (b, 1)))
        for number, (name, a, b) in enumerate(zip(names, ends, ends[1:], strict=False))
    ]
    return text.scene(
        f'plane = "stress"\n[contact]\n{head}',
        [
            *(
                text.material(name, modulus=e, poisson=0.0)
                for name, e in zip(names, moduli, strict=True)
            ),
            text.interface("joint", 30.0, more=joint) + law,
            *blocks,
            '[[supports]]\nname = "left"\nsegment = [[0, 0], [0, 1]]\nfix = ["x", "y"]\n',
            '[[loads]]\nname = "pull"\nkind = "edge"\ntraction = [1e6, 0]\n'
            f"segment = [[{ends[-1]}, 0], [{ends[-1]}, 1]]\n",
            more,
        ],
    )


@pytest.mark.parametrize("bond_stiffness", [0.01, 100.0])
def test_a_bar_of_two_materials_is_as_long_as_its_materials_make_it(bond_stiffness):
    more = f"[formulation.contact]\nbond_stiffness = {bond_stiffness}\n"
    run = nmm.run(parse_scene(bar(more=more)))
    # The springs of the held end are 1000 E; constant strains hold the solution.
    series = 1e6 * (0.5 / 1e9 + 2.0 / 10e9)
    assert np.ptp(run.displacement[:, 0]) == pytest.approx(series, rel=1e-6)


@pytest.mark.parametrize("energy", [1.0, 100.0, 1e4])
def test_a_whole_bond_is_not_asked_how_soft_its_spring_would_be(energy):
    """Springs of 3e9 Pa/m hold nothing here; 100 J/m2 would ask for 5e10, 1 J/m2 for 5e12."""
    law = f'law = "linear_softening"\nfracture_energy = {energy}\n'
    run = nmm.run(parse_scene(bar(law=law)))
    assert run.summary.status == "converged"
    series = 1e6 * (0.5 / 1e9 + 2.0 / 10e9)
    assert np.ptp(run.displacement[:, 0]) == pytest.approx(series, rel=1e-6)


@pytest.mark.parametrize("degree", [1, 2])
def test_random_blocks_under_uniform_tension_are_all_strained_alike(degree):
    scene = text.scene(
        'plane = "stress"\n[contact]\n',
        [
            text.material("rock", modulus=1e9, poisson=0.25),
            text.interface("joint", 30.0, more={"cohesion": 1e9, "tensile_strength": 1e9})
            + "bonded = true\n",
            '[[tessellations]]\nname = "t"\nmaterial = "rock"\nblocks = 20\nseed = 3\n'
            "region = [[0, 0], [2, 0], [2, 1], [0, 1]]\n",
            '[[supports]]\nname = "left"\nsegment = [[0, 0], [0, 1]]\nfix = ["x"]\n',
            '[[supports]]\nname = "foot"\npoint = [0, 0]\nfix = ["y"]\n',
            '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[2, 0], [2, 1]]\n'
            "traction = [1e4, 0]\n",
            f'[formulation.cover]\nfunctions = "monomials"\ndegree = {degree}\n',
        ],
    )
    stress = nmm.run(parse_scene(scene)).stress
    # The held edge turns by 1e-5 of the strain, as the elongation; residual 1e-8.
    assert np.abs(stress - [1e4, 0, 0]).max() < 1e4 * 1e-4


@pytest.mark.parametrize("increment", [0.07, 1.0])
def test_a_brittle_bond_breaks_where_the_traction_is_the_strength(increment):
    head = '[loading]\nuntil = "failure"\nmaximum_factor = 9\n'
    more = f"[formulation.loading]\nincrement = {increment}\ntolerance = 1e-3\n"
    run = nmm.run(parse_scene(bar(head=head, more=more)))
    assert run.summary.status == "failure_load"
    assert run.summary.failure_factor == pytest.approx(3.0, rel=2e-3)


def test_a_bond_that_softens_takes_its_fracture_energy_and_no_more_than_its_strength():
    # Driven to 1.5 widths of the crack; the bar is stiff beside the law: no snap-back.
    energy, modulus = 100.0, 1e12
    width = 2 * energy / STRENGTH
    drive = (
        '[[supports]]\nname = "drive"\nsegment = [[2, 0], [2, 1]]\nfix = ["x", "y"]\n'
        f"displacement = [{1.5 * width!r}, 0]\n[formulation.loading]\nincrement = 0.02\n"
    )
    scene = bar(
        head="[loading]\nuntil = 1\n",
        more=drive,
        law=f"fracture_energy = {energy}\n",
        lengths=(1.0, 1.0),
        moduli=(modulus, modulus),
    )
    scene = scene[: scene.index("[[loads]]")] + scene[scene.index('[[supports]]\nname = "drive') :]
    run = nmm.run(parse_scene(scene))
    force, way = run.history["reaction:drive:x"], run.history["load_factor"] * 1.5 * width
    assert force.max() <= STRENGTH * (1 + 1e-9)
    assert force.max() > 0.97 * STRENGTH  # a step is 3 % of the width of the crack
    assert force[-1] == pytest.approx(0.0, abs=1e-6 * STRENGTH)
    work = np.trapezoid(np.append(0, force), np.append(0, way))
    # The springs that take over give back 6e-4 of it as the bond softens, in blocks of 1 m.
    assert work == pytest.approx(energy, rel=1e-3)
    assert run.history["friction_loss"][-1] == pytest.approx(energy, rel=1e-3)


def test_blocks_that_fly_bonded_keep_momentum_and_energy():
    scene = text.scene(
        'plane = "stress"\nduration = 0.1\n[contact]\n[inertia]\n',
        [
            text.material("rock", modulus=1e9, poisson=0.2, density=2000.0),
            text.interface("joint", 30.0, more={"cohesion": 1e9, "tensile_strength": 1e9})
            + "bonded = true\n",
            text.block("a", "rock", text.rectangle((0, 0), (1, 1))),
            text.block("b", "rock", text.rectangle((1, 0), (2.5, 1))),
            '[[initial_velocities]]\nblock = "all"\nvelocity = [1, 2]\nangular_velocity = 3\n',
            '[formulation.integrator]\ntype = "newmark"\nstep = 1e-3\n',
        ],
    )
    run = nmm.run(parse_scene(scene))
    assert run.summary.status == "converged"
    total = run.history["kinetic_energy"] + run.history["strain_energy"]
    total = total + run.history["contact_energy"]
    # Terms and matter are linear in the strain, 3e-5 here, in axes that turn with the blocks.
    assert np.abs(total / total[0] - 1).max() < 1e-4
    assert run.summary.audits["momentum"] < 1e-12
    assert run.summary.audits["angular_momentum"] < 1e-12


def test_terms_are_refused_beside_matter_whose_traction_they_do_not_know():
    plastic = bar().replace("poisson_ratio = 0.0\n", 'poisson_ratio = 0.0\nlaw = "mises"\n', 1)
    plastic = plastic.replace('law = "mises"\n', 'law = "von_mises"\nyield_stress = 1e6\n')
    text_ = plastic + '[formulation.contact]\nbonds = "nitsche"\n'
    with pytest.raises(NmmError, match=r"\[contact\] bonds"):
        nmm.run(parse_scene(text_))


def test_an_initial_stress_in_equilibrium_moves_nothing_and_loads_its_bonds():
    stress = '[[initial_stresses]]\nblock = "all"\nstress = [2e6, 0, 0]\n'
    run = nmm.run(parse_scene(bar(more=stress).replace("[1e6, 0]", "[2e6, 0]")))
    # The spring of the held end lets all move alike.
    assert np.ptp(run.displacement[:, 0]) < 1e-9 * 2e6 / 1e9
    frame = run.frames[-1]
    assert frame.contact_force[:, 0].sum() == pytest.approx(2e6, rel=1e-9)


def test_blocks_of_one_strain_in_a_row_bend_as_their_material():
    # Two joints between the middles of blocks of 1 m: E I phi = M x 2 m, E / h of each. The couple
    # shears the block that it acts on.
    modulus, force = 1e9, 1e3
    couple = (
        '[[loads]]\nname = "up"\nkind = "point"\npoint = [5, 0]\nforce = [1e3, 0]\n'
        '[[loads]]\nname = "down"\nkind = "point"\npoint = [5, 1]\nforce = [-1e3, 0]\n'
    )
    scene = bar(lengths=(1.0,) * 5, moduli=(modulus,) * 5, cohesion=1e9)
    run = nmm.run(parse_scene(scene[: scene.index("[[loads]]")] + couple))
    place, moved = run.manifold.elements.points, run.displacement

    def rotation(left):
        x = place[:, 0]
        some = (x > left - 0.1) & (x < left + 1.1)
        gradient = np.linalg.lstsq(np.c_[np.ones(some.sum()), place[some]], moved[some])[0][1:]
        return (gradient[0, 1] - gradient[1, 0]) / 2

    turned = rotation(3.0) - rotation(1.0)
    assert turned == pytest.approx(12 * force * 2 / modulus, rel=RESIDUAL)


def test_what_the_penalty_counts_of_a_jump_is_its_mean_and_a_share_of_the_rest():
    scene = bar(lengths=(1.0, 1.0), moduli=(1e9, 1e9))
    run = nmm.run(parse_scene(scene))
    joint = run.stepper.plan.contact.record.book.points
    share = joint.history["tied"]
    found = counted(joint, np.array([1.0, 3.0]))
    assert found.sum() == pytest.approx(4.0, rel=1e-12)
    assert found[1] - found[0] == pytest.approx(2 * share[0], rel=1e-12)
    # E / h over the penalty, 1.5 times its least E / 2: a face half a block from the middle.
    assert share == pytest.approx([4 / 3, 4 / 3], rel=1e-9)


@pytest.mark.parametrize("strength", [5e4, 1e5])
def test_soft_terms_hand_over_springs_as_firm_as_their_law_asks_for(strength):
    """Blocks of 1 m and 0.1 GPa: terms of 0.16 GPa/m, where 0.1 MPa and 20 J/m2 ask for 0.25."""
    rows = [(0, [0, 1, 2, 3, 4]), (1, [0, 0.5, 1.5, 2.5, 3.5, 4])]
    joint = {"cohesion": 2 * strength, "tensile_strength": strength, "bonded": True}
    law = 'law = "linear_softening"\nfracture_energy = 20.0\n'
    scene = text.scene(
        'plane = "stress"\nduration = 0.07\n[inertia]\n[gravity]\n[contact]\n'
        '[formulation.integrator]\ntype = "newmark"\nstep = 1e-3\n',
        [
            text.material("soft", modulus=1e8, poisson=0.2, density=2000.0),
            text.interface("joint", 30.0, more=joint) + law,
            *(
                text.block(f"b{row}{number}", "soft", text.rectangle((a, row), (b, row + 1)))
                for row, ends in rows
                for number, (a, b) in enumerate(pairwise(ends))
            ),
            '[[supports]]\nname = "wall"\nsegment = [[0, 0], [0, 2]]\nfix = ["x", "y"]\n',
        ],
    )
    run = nmm.run(parse_scene(scene))
    assert run.summary.status == "converged", run.summary.sentence
    # It breaks across its depth of 2 m at least.
    assert run.history["bonded"][-1] < run.history["bonded"][0]
    assert run.history["friction_loss"][-1] > 2 * 20.0
