"""Matter that softens: what bands of it take, whatever the cells."""

from dataclasses import replace

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError, SceneError
from nmm.materials.drucker_prager import DruckerPragerPlasticity
from nmm.materials.mohr_coulomb import MohrCoulombPlasticity
from nmm.materials.von_mises import VonMisesPlasticity
from nmm.testing import check_law
from nmm.verification.problems.matter.softening_layer import sheared_layer

E, NU, YIELD, ENERGY = 1e9, 0.25, 1e6, 2e3
SHEAR = E / 2 / (1 + NU)
HEIGHT, WIDTH, PUSH = 1.0, 0.25, 5e4
CLAY = VonMisesPlasticity(E, NU, YIELD, softening_energy=ENERGY, residual_stress=1e5)
PHI = np.pi / 6
SOFT = {"softening_energy": ENERGY, "residual_cohesion": 1e5}
TURNING = {**SOFT, "residual_friction_angle": PHI / 2, "residual_dilation_angle": 0.02}
FRICTIONAL = {
    "pyramid": MohrCoulombPlasticity(E, NU, YIELD, PHI, 0.1, **SOFT),
    "associated pyramid": MohrCoulombPlasticity(E, NU, YIELD, PHI, PHI, **SOFT),
    "cut pyramid": MohrCoulombPlasticity(E, NU, YIELD, PHI, PHI, 0.6e6, **SOFT),
    "cohesive pyramid": MohrCoulombPlasticity(E, NU, YIELD, 0.0, **SOFT),
    "cone": DruckerPragerPlasticity(E, NU, YIELD, PHI, 0.1, **SOFT),
    "associated cone": DruckerPragerPlasticity(E, NU, YIELD, PHI, PHI, **SOFT),
    "cut cone": DruckerPragerPlasticity(E, NU, YIELD, PHI, PHI, 0.6e6, **SOFT),
    "turning pyramid": MohrCoulombPlasticity(E, NU, YIELD, PHI, 0.1, **TURNING),
    "turning cut pyramid": MohrCoulombPlasticity(E, NU, YIELD, PHI, 0.1, 0.6e6, **TURNING),
    "smoothed pyramid": MohrCoulombPlasticity(
        E,
        NU,
        YIELD,
        PHI,
        PHI,
        **{**TURNING, "residual_friction_angle": 0.0} | {"residual_dilation_angle": 0.0},
    ),
    "turning cone": DruckerPragerPlasticity(E, NU, YIELD, PHI, 0.1, **TURNING),
    "turning cut cone": DruckerPragerPlasticity(E, NU, YIELD, PHI, 0.1, 0.6e6, **TURNING),
}
# Strength in shear without mean stress, and the lines that make a material of it.
SHEARED = {
    "von_mises": (YIELD / np.sqrt(3), f"yield_stress = {YIELD}"),
    "mohr_coulomb": (0.5e6, f"cohesion = {0.5e6 / np.cos(PHI)}\nfriction_angle = {PHI}"),
    # Between the lines through the middle of sides of equal collapse: xi is 3 / sqrt(9 + 12 tan2).
    "drucker_prager": (0.5e6, f"cohesion = {0.5e6 / 0.8320502943}\nfriction_angle = {PHI}"),
}


def sheared(size, law="von_mises", cover="quads", degree=0, way=0.0042):
    """A layer whose top is pushed aside by a way (m); weight aside loads its foot a little more."""
    return nmm.parse_scene(
        f"""plane = "strain"
        [materials.clay]
        law = "{law}"
        young_modulus = {E}
        poisson_ratio = {NU}
        {SHEARED[law][1]}
        softening_energy = {ENERGY}
        [formulation.cover]
        type = "{cover}"
        size = {size}
        degree = {degree}
        [formulation.supports]
        method = "lagrange"
        """
        + "".join(sheared_layer("clay", (WIDTH, HEIGHT), way, PUSH, 0.01))
    )


def stress_at_end(size, strength, modulus, way):
    """Stress (Pa) at the end of a body 1 m long while the cells at its foot soften alone.

    Their stress ``t + b (H - h / 2)`` is ``f (1 - f w / 2 G)`` where they have given way by ``w``,
    and ``U = t H / E + b H^2 / 2 E + w``.
    """
    eased = 2 * ENERGY / strength**2
    more = PUSH * (HEIGHT - size / 2)
    known = way - PUSH * HEIGHT**2 / 2 / modulus - eased * (strength - more)
    return known / (HEIGHT / modulus - eased)


@pytest.mark.parametrize("law", SHEARED)
@pytest.mark.parametrize("size", [0.25, 0.125])
def test_a_band_takes_the_same_energy_whatever_the_cells(size, law):
    """The force falls along the closed form, in which the cells are but where the band lies."""
    way = 0.0042 if law == "von_mises" else 0.0048
    run = nmm.run(sheared(size, law, way=way))
    assert run.summary.status == "converged", run.summary.sentence
    found = run.history["reaction:top:x"][-1] / WIDTH
    # Forces are half of the peak, on a branch that softens: increments are balanced to 1e-10.
    assert found == pytest.approx(stress_at_end(size, SHEARED[law][0], SHEAR, way), rel=1e-6)


def pulled(size, way):
    """A bar of 1 m that is pulled by a way (m) at its right end, its left a little more."""
    return nmm.parse_scene(
        f"""plane = "strain"
        [materials.rock]
        law = "mohr_coulomb"
        young_modulus = {E}
        poisson_ratio = 0.0
        cohesion = {YIELD}
        friction_angle = {PHI}
        tensile_strength = {YIELD}
        softening_energy = {ENERGY}
        [[blocks]]
        name = "bar"
        material = "rock"
        vertices = [[0, 0], [1, 0], [1, {WIDTH}], [0, {WIDTH}]]
        [[supports]]
        name = "left"
        segment = [[0, 0], [0, {WIDTH}]]
        fix = ["x"]
        [[supports]]
        name = "down"
        point = [0, 0]
        fix = ["y"]
        [[supports]]
        name = "right"
        segment = [[1, 0], [1, {WIDTH}]]
        fix = ["x"]
        displacement = [{way}, 0]
        [[loads]]
        name = "more"
        kind = "body"
        density = [{PUSH}, 0]
        [loading]
        scaled = ["right"]
        until = 1.0
        [formulation.loading]
        increment = 0.01
        [formulation.cover]
        type = "quads"
        size = {size}
        degree = 0
        [formulation.supports]
        method = "lagrange"
        """
    )


@pytest.mark.parametrize("size", [0.25, 0.125])
def test_a_bar_that_opens_takes_the_same_energy_whatever_the_cells(size):
    """A row of cells across it opens along the line of a cohesive crack of linear softening."""
    run = nmm.run(pulled(size, 0.003))
    assert run.summary.status == "converged", run.summary.sentence
    found = run.history["reaction:right:x"][-1] / WIDTH
    assert found == pytest.approx(stress_at_end(size, YIELD, E, 0.003), rel=1e-6)


def test_a_point_takes_its_energy_over_the_size_of_its_cell():
    """``G / h`` beyond what the residual stress takes; kinks lie within steps, to 1e-4."""
    size, ways = 0.05, np.linspace(0, 1.0, 4001)
    history = {name: one[None] for name, one in CLAY.variables("strain").items()}
    history["cell_size"] = np.array([[size]])
    stress = []
    for way in ways:
        found = CLAY.update(np.array([[0, 0, way]]), history, "strain", 0.0)
        history = {**found.history, "cell_size": history["cell_size"]}
        stress.append(found.stress[0, 2])
    assert stress[-1] == pytest.approx(1e5 / np.sqrt(3), rel=1e-12)
    flowed = history["accumulated_plastic_strain"][0, 0]
    work = np.trapezoid(stress, ways) - stress[-1] ** 2 / 2 / SHEAR
    assert work - 1e5 * flowed == pytest.approx(ENERGY / size, rel=1e-4)


@pytest.mark.parametrize("kind", ["cohesive pyramid", "cone", "pyramid"])
def test_ground_under_pressure_takes_its_energy_beyond_that_of_friction(kind):
    """Sheared at constant volume under 3 MPa the mean stress stays, and friction with it."""
    law = MohrCoulombPlasticity(E, NU, YIELD, PHI, **SOFT)
    if kind == "cone":
        law = DruckerPragerPlasticity(E, NU, YIELD, PHI, **SOFT)
    elif kind == "cohesive pyramid":
        law = MohrCoulombPlasticity(E, NU, YIELD, 0.0, **SOFT)
    size, mean, ways = 0.05, 3e6, np.linspace(0, 0.4, 4001)
    volume = -mean * 3 * (1 - 2 * NU) / E
    history = {name: one[None].copy() for name, one in law.variables("strain").items()}
    history["plastic_strain"][0, 3] = -volume / 3
    history["cell_size"] = np.array([[size]])
    stress = []
    for way in ways:
        found = law.update(np.array([[volume / 3, volume / 3, way]]), history, "strain", 0.0)
        history = {**found.history, "cell_size": history["cell_size"]}
        stress.append(found.stress[0, 2])
    cohesive, frictional = {
        "pyramid": (np.cos(PHI), np.sin(PHI)),
        "cohesive pyramid": (1.0, 0.0),
        "cone": law.slopes(PHI)[::-1] if kind == "cone" else (),
    }[kind]
    assert max(stress) == pytest.approx(YIELD * cohesive + mean * frictional, rel=1e-3)
    assert stress[-1] == pytest.approx(1e5 * cohesive + mean * frictional, rel=1e-12)
    flowed = ways[-1] - stress[-1] / SHEAR
    work = np.trapezoid(stress, ways) - stress[-1] ** 2 / 2 / SHEAR
    assert work - stress[-1] * flowed == pytest.approx(ENERGY / size, rel=1e-4)


@pytest.mark.parametrize("done", [0.3, 0.7, 1.0])
@pytest.mark.parametrize("law", [MohrCoulombPlasticity, DruckerPragerPlasticity])
def test_friction_that_falls_follows_the_flow_under_pressure(law, done):
    """Sheared at constant volume under 3 MPa, without dilation.

    The strength ``t`` of a share ``D`` is ``a(D) t = xi0 c(D) + p b(D)``, a and b lines from 1 and
    eta0 to ``xi0 / xir`` times 1 and etar; plastic shear grows by ``2 G_f a(D) / (h xi0 dc) dD``.
    """
    last, size, mean = PHI / 2, 0.05, 3e6
    ground = law(E, NU, YIELD, PHI, **SOFT, residual_friction_angle=last)
    pyramid = law is MohrCoulombPlasticity
    root = np.sqrt(9 + 12 * np.tan([PHI, last]) ** 2)
    eta = np.sin([PHI, last]) if pyramid else 3 * np.tan([PHI, last]) / root
    xi = np.cos([PHI, last]) if pyramid else 3 / root
    more = xi[0] / xi[1] - 1
    friction = eta[0] + done * (xi[0] / xi[1] * eta[1] - eta[0])
    shear = (xi[0] * (YIELD - done * 0.9 * YIELD) + mean * friction) / (1 + done * more)
    flow = 2 * ENERGY / size / xi[0] / (0.9 * YIELD) * (done + more * done**2 / 2)
    volume = -mean * 3 * (1 - 2 * NU) / E
    history = {name: one[None].copy() for name, one in ground.variables("strain").items()}
    history["plastic_strain"][0, 3] = -volume / 3
    history["cell_size"] = np.array([[size]])
    ways = np.linspace(0, shear / SHEAR + flow, 1001)[1:]
    for way in ways:
        found = ground.update(np.array([[volume / 3, volume / 3, way]]), history, "strain", 0.0)
        history = {**found.history, "cell_size": history["cell_size"]}
    # Steps are implicit, of order one: 1 / 1000 of the way, of which ways turn by a tenth.
    assert history["softened"][0, 0] == pytest.approx(done, abs=2e-4)
    assert found.stress[0, 2] == pytest.approx(shear, rel=2e-4)


@pytest.mark.parametrize("law", [MohrCoulombPlasticity, DruckerPragerPlasticity])
@pytest.mark.parametrize("cut", [None, 0.6e6])
def test_ground_whose_friction_has_fallen_is_ground_of_what_is_left(law, cut):
    random = np.random.default_rng(11)
    ground = law(E, NU, YIELD, PHI, 0.1, cut, **TURNING)
    tension = 0.1 * (YIELD / np.tan(PHI) if cut is None else cut)
    if law is DruckerPragerPlasticity and cut is None:
        (eta, xi) = ground.slopes(PHI)
        tension = 0.1 * xi * YIELD / eta
    left = law(E, NU, 0.1 * YIELD, PHI / 2, 0.02, tension)
    strain = random.normal(size=(500, 3)) * 10 ** random.uniform(-4, -1, (500, 1))
    start = {name: np.tile(one, (500, 1)) for name, one in ground.variables("strain").items()}
    start["cell_size"] = np.full((500, 1), 0.05)
    start["softened"][:] = 1.0
    found = ground.update(strain, start, "strain", 0.0)
    expected = left.update(strain, start, "strain", 0.0)
    np.testing.assert_allclose(found.stress, expected.stress, atol=1e-2)
    np.testing.assert_allclose(found.tangent, expected.tangent, atol=1e-6 * E)


@pytest.mark.parametrize("name", FRICTIONAL)
def test_ground_that_softens_keeps_what_every_law_does(name):
    check_law(FRICTIONAL[name], planes=("strain",), strains=(1e-3, 1e-2, 1.0))


@pytest.mark.parametrize("name", FRICTIONAL)
def test_softening_without_end_is_no_softening(name):
    """With 1e9 times the energy strengths fall by 1e-9 and less."""
    random = np.random.default_rng(3)
    law = FRICTIONAL[name]
    none = {"residual_friction_angle": None, "residual_dilation_angle": None}
    hard = replace(law, softening_energy=None, residual_cohesion=0.0, **none)
    soft = replace(law, softening_energy=1e12)
    strain = random.normal(size=(500, 3)) * 10 ** random.uniform(-4, -1, (500, 1))
    start = {name: np.tile(one, (500, 1)) for name, one in soft.variables("strain").items()}
    start["cell_size"] = np.full((500, 1), 0.05)
    found = soft.update(strain, start, "strain", 0.0)
    expected = hard.update(strain, start, "strain", 0.0)
    np.testing.assert_allclose(found.stress, expected.stress, atol=1e-2)


def test_a_law_that_softens_keeps_what_every_law_does():
    check_law(CLAY, planes=("strain",))


@pytest.mark.parametrize(
    "constants",
    [
        {"softening_energy": 0.0},
        {"residual_cohesion": 1.0},
        {"softening_energy": 1.0, "residual_cohesion": YIELD},
        {"residual_friction_angle": 0.1},
        {"softening_energy": 1.0, "residual_friction_angle": 0.6},
        {"softening_energy": 1.0, "residual_friction_angle": -0.1},
        {"softening_energy": 1.0, "residual_dilation_angle": 0.1},
        {"softening_energy": 1.0, "dilation_angle": 0.2, "residual_friction_angle": 0.1},
    ],
)
def test_ground_that_does_not_soften_is_refused(constants):
    with pytest.raises(FormulationError, match="expected"):
        MohrCoulombPlasticity(E, NU, YIELD, PHI, **constants)


def test_cells_in_which_ground_snaps_back_are_refused_with_the_largest():
    """At the apex ``T^2 h / 2 G_f`` reaches the bulk modulus; without friction ``4 c^2 h / 2 G_f``
    reaches ``3 G``, on the edge where two planes flow alike.
    """
    angle = np.pi / 18
    law = MohrCoulombPlasticity(E, NU, YIELD, angle, angle, softening_energy=ENERGY)
    bulk = E / 3 / (1 - 2 * NU)
    most = 2 * ENERGY * bulk / (YIELD / np.tan(angle)) ** 2
    law.check_size(np.array([0.999 * most]))
    with pytest.raises(FormulationError, match=f"below {most:.4g} m.*or give a tensile_strength"):
        law.check_size(np.array([1.001 * most]))
    law = MohrCoulombPlasticity(E, NU, YIELD, 0.0, softening_energy=ENERGY)
    most = 3 * SHEAR * 2 * ENERGY / (2 * YIELD) ** 2
    law.check_size(np.array([0.999 * most]))
    with pytest.raises(FormulationError, match=f"expected cells below {most:.4g} m"):
        law.check_size(np.array([1.001 * most]))


@pytest.mark.parametrize("law", [MohrCoulombPlasticity, DruckerPragerPlasticity])
def test_friction_snaps_back_in_cells_too_large_for_the_pressure(law):
    """Sheared under 3 MPa points fall evenly in cells of 0.9, and at once in those of 1.7."""
    ground, mean = law(E, NU, YIELD, PHI, **SOFT, residual_friction_angle=PHI / 2), 3e6
    pressure = np.full(2, mean)
    size = np.array([0.9, 1.7]) / ground.size_share(np.ones(2), pressure)
    volume = -mean * 3 * (1 - 2 * NU) / E
    history = {name: np.tile(one, (2, 1)) for name, one in ground.variables("strain").items()}
    history["plastic_strain"][:, 3] = -volume / 3
    history["cell_size"] = size[:, None]
    done, jump = np.zeros(2), np.zeros(2)
    for way in np.linspace(0.8, 1.1, 300) * (YIELD + mean * np.tan(PHI)) * np.cos(PHI) / SHEAR:
        found = ground.update(np.tile([volume / 3, volume / 3, way], (2, 1)), history, "strain", 0)
        history = {**found.history, "cell_size": size[:, None]}
        done, before = history["softened"][:, 0], done
        jump = np.maximum(jump, done - before)
    assert done.min() > 0.2
    assert jump[0] < 0.05
    assert jump[1] > 0.5


@pytest.mark.parametrize(
    "constants",
    [
        {"hardening_modulus": 1e6, "softening_energy": 1.0},
        {"softening_energy": 1.0, "residual_stress": YIELD},
        {"residual_stress": 1.0},
        {"softening_energy": 0.0},
    ],
)
def test_constants_that_do_not_soften_are_refused(constants):
    with pytest.raises(FormulationError, match="expected"):
        VonMisesPlasticity(E, NU, YIELD, **constants)


def test_cells_that_soften_faster_than_they_unload_are_refused_with_the_largest():
    """``3 G = s^2 h / 2 G_f`` at 4.8 m."""
    with pytest.raises(FormulationError, match=r"expected cells below 4.8 m"):
        CLAY.__class__(E, NU, YIELD, softening_energy=ENERGY).check_size(np.array([1.0, 4.81]))


def test_softening_in_plane_stress_is_refused_by_line():
    text = (
        'plane = "stress"\n[materials.m]\nlaw = "von_mises"\nyoung_modulus = 1e9\n'
        "poisson_ratio = 0.2\nyield_stress = 1e6\nsoftening_energy = 10.0\n"
        '[[blocks]]\nname = "b"\nmaterial = "m"\nvertices = [[0, 0], [1, 0], [1, 1]]\n'
    )
    with pytest.raises(SceneError, match="scene:7: .*softening_energy.*plane strain"):
        nmm.parse_scene(text)


@pytest.mark.parametrize(
    ("line", "constants"),
    [
        (9, 'residual_friction_angle = "40 deg"\nresidual_dilation_angle = "0 deg"'),
        (10, 'residual_friction_angle = "20 deg"\nresidual_dilation_angle = "21 deg"'),
        (9, 'dilation_angle = "31 deg"\nresidual_friction_angle = "20 deg"'),
    ],
)
def test_angles_that_rise_are_refused_by_the_line_of_their_key(line, constants):
    text = (
        'plane = "strain"\n[materials.m]\nlaw = "mohr_coulomb"\nyoung_modulus = 1e9\n'
        'poisson_ratio = 0.2\ncohesion = 1e4\nfriction_angle = "30 deg"\nsoftening_energy = 10.0\n'
        f"{constants}\n"
        '[[blocks]]\nname = "b"\nmaterial = "m"\nvertices = [[0, 0], [1, 0], [1, 1]]\n'
    )
    scene = nmm.parse_scene(text)
    with pytest.raises(FormulationError, match=rf"scene:{line}: materials.m.*_angle: .*expected"):
        nmm.run(scene)


@pytest.mark.parametrize("degree", [0, 1])
def test_a_column_that_softens_has_a_failure_load(degree):
    """Its foot yields at ``2 c - w H``, and no part bears more than ``2 c``.

    Beyond the peak iterations go to and fro between matter that softens and matter that unloads.
    """
    weight, cohesion = 2000 * 9.81 * 2, 1e5
    text = f"""plane = "strain"
        [gravity]
        [materials.clay]
        law = "mohr_coulomb"
        young_modulus = 1e8
        poisson_ratio = 0.3
        density = 2000
        cohesion = {cohesion}
        friction_angle = 0
        softening_energy = 5e3
        [[blocks]]
        name = "column"
        material = "clay"
        vertices = [[0, 0], [1, 0], [1, 2], [0, 2]]
        [[supports]]
        name = "foot"
        segment = [[0, 0], [1, 0]]
        fix = ["y"]
        [[supports]]
        name = "left"
        segment = [[0, 0], [0, 2]]
        fix = ["x"]
        [[loads]]
        name = "press"
        kind = "edge"
        segment = [[0, 2], [1, 2]]
        traction = [0, -1e5]
        [loading]
        scaled = ["press"]
        until = "failure"
        [formulation.cover]
        type = "quads"
        size = 0.25
        degree = {degree}
        """
    found = nmm.run(nmm.parse_scene(text)).summary
    assert found.status == "failure_load", found.sentence
    assert "softens" in found.sentence
    assert 2 * cohesion - weight <= found.failure_load <= 2 * cohesion
