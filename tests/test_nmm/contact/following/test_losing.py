"""What bonds at their limit lose by jump, against the areas under curves of strength by hand."""

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from nmm.contact.following.losing import losing
from nmm.contact.following.path_problem import PathProblem
from nmm.contact.laws.tractions import ContactForces
from nmm.contact.points.contact_rows import ContactRows
from nmm.interfaces.softening import LinearSoftening

STRENGTH, COHESION, TAN, ENERGY, SLIDING, SPRING = 2e5, 3e5, 0.5, 50.0, 200.0, 1e12
LAW = LinearSoftening(
    friction_angle=float(np.arctan(TAN)),
    cohesion=COHESION,
    tensile_strength=STRENGTH,
    bonded=True,
    fracture_energy=ENERGY,
    shear_fracture_energy=SLIDING,
)


def lost_by_jump(gap: float, slip: float, damage: float) -> np.ndarray:
    """Energy (J) of one square metre by gap and slip: two unknowns, its jumps."""
    history = {
        "bonded": np.array([True]),
        "plastic_slip": np.zeros(1),
        "damage": np.array([damage]),
    }
    stiff = (np.array([SPRING]), np.array([SPRING]))

    def law(gaps: np.ndarray, slips: np.ndarray) -> ContactForces:
        found = LAW.update(history, gaps, slips, stiff)
        return ContactForces(found.traction, found.history, lambda: found.tangent)

    rows = ContactRows(csr_array([[1.0, 0.0]]), csr_array([[0.0, 1.0]]), np.array([[0.0, 1.0]]))
    problem = PathProblem(
        csc_array(np.eye(2)), np.zeros(2), rows, np.array([gap]), np.array([slip]), law, 1.0
    )
    return losing(problem, stiff, history)


def test_a_bond_that_opens_loses_the_area_between_its_secants() -> None:
    # f_t / 2 for each width of the crack; the spring takes back as much as the strength falls.
    width = 2 * ENERGY / STRENGTH
    damage, fall = 0.4, STRENGTH / width
    left = STRENGTH * (1 - damage)
    lost = lost_by_jump(damage * width + left / SPRING, 0.0, damage)
    assert lost[0] == pytest.approx(STRENGTH / 2 / (1 - fall / SPRING), rel=1e-6)
    assert lost[1] == 0


@pytest.mark.parametrize("way", [1, -1])
def test_a_pressed_bond_that_slides_loses_cohesion_and_friction(way: int) -> None:
    pressure, damage = 1e5, 0.3
    bound = COHESION * (1 - damage) + TAN * pressure
    fall = COHESION**2 / (2 * SLIDING)
    lost = lost_by_jump(-pressure / SPRING, way * bound / SPRING, damage)
    assert lost[1] == pytest.approx(way * bound / (1 - fall / SPRING), rel=1e-6)
    # Pressed further by 1 m it would bear mu k more, of which the spring stores its own.
    assert abs(lost[0]) < 2 * TAN * bound


def test_bonds_below_their_limit_lose_nothing() -> None:
    assert not lost_by_jump(0.5 * STRENGTH / SPRING, 0.0, 0.0).any()
    assert not lost_by_jump(-1e5 / SPRING, 0.9 * COHESION / SPRING, 0.0).any()
