"""Von Mises matter that softens: what bands of it take, whatever the cells."""

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError, SceneError
from nmm.materials.von_mises import VonMisesPlasticity
from nmm.testing import check_law

E, NU, YIELD, ENERGY = 1e9, 0.25, 1e6, 2e3
SHEAR = E / 2 / (1 + NU)
HEIGHT, WIDTH, PUSH = 1.0, 0.25, 5e4
CLAY = VonMisesPlasticity(E, NU, YIELD, softening_energy=ENERGY, residual_stress=1e5)


def sheared(size, cover="quads", degree=0, way=0.0042):
    """A layer whose top is pushed aside by a way (m); weight aside loads its foot a little more."""
    walls = "".join(
        f'[[supports]]\nname = "{name}"\nsegment = [[{x}, 0], [{x}, {HEIGHT}]]\nfix = ["y"]\n'
        for name, x in (("left", 0), ("right", WIDTH))
    )
    return nmm.parse_scene(
        f"""plane = "strain"
        [materials.clay]
        law = "von_mises"
        young_modulus = {E}
        poisson_ratio = {NU}
        yield_stress = {YIELD}
        softening_energy = {ENERGY}
        [[blocks]]
        name = "layer"
        material = "clay"
        vertices = [[0, 0], [{WIDTH}, 0], [{WIDTH}, {HEIGHT}], [0, {HEIGHT}]]
        {walls}
        [[supports]]
        name = "foot"
        segment = [[0, 0], [{WIDTH}, 0]]
        fix = ["x", "y"]
        [[supports]]
        name = "top"
        segment = [[0, {HEIGHT}], [{WIDTH}, {HEIGHT}]]
        fix = ["x", "y"]
        displacement = [{way}, 0]
        [[loads]]
        name = "more"
        kind = "body"
        density = [{PUSH}, 0]
        [loading]
        scaled = ["top"]
        until = 1.0
        [formulation.loading]
        increment = 0.01
        [formulation.cover]
        type = "{cover}"
        size = {size}
        degree = {degree}
        [formulation.supports]
        method = "lagrange"
        """
    )


def stress_at_top(size, way=0.0042):
    """Shear stress (Pa) at the top while the lowest row of cells softens alone.

    Its stress ``t + b (H - h / 2)`` is ``(s - c' p) / sqrt(3)``, and ``U = t H / G + b H^2 / 2 G +
    sqrt(3) p h`` with ``c' h = s^2 / 2 G_f``.
    """
    eased = 2 * ENERGY / YIELD**2
    more = PUSH * (HEIGHT - size / 2)
    known = way - PUSH * HEIGHT**2 / 2 / SHEAR - eased * (np.sqrt(3) * YIELD - 3 * more)
    return known / (HEIGHT / SHEAR - 3 * eased)


@pytest.mark.parametrize("size", [0.25, 0.125])
def test_a_band_takes_the_same_energy_whatever_the_cells(size):
    """The force falls along the closed form, in which the cells are but where the band lies."""
    run = nmm.run(sheared(size))
    assert run.summary.status == "converged", run.summary.sentence
    found = run.history["reaction:top:x"][-1] / WIDTH
    # Forces are half of the peak, on a branch that softens: increments are balanced to 1e-10.
    assert found == pytest.approx(stress_at_top(size), rel=1e-6)


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


def test_a_law_that_softens_keeps_what_every_law_does():
    check_law(CLAY, planes=("strain",))


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
