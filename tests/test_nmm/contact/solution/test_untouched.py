"""Bodies in flight that nothing is near: as without contact, by a factor that is kept."""

import numpy as np

import nmm

TEXT = """
plane = "strain"
duration = "0.2 s"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = "2600 kg/m^3"
[interfaces.joint]
friction_angle = "20 deg"
[[blocks]]
name = "a"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "b"
material = "rock"
vertices = [[3, 0], [4, 0], [4, 1], [3, 1]]
[[initial_velocities]]
block = "a"
velocity = [1.0, 0.5]
angular_velocity = 2.0
[gravity]
[inertia]
[formulation]
integrator = { type = "newmark", step = "5 ms" }
"""


def untouched():
    """Return the class that solves such steps; not imported where nothing may touch."""
    from nmm.contact.solution.untouched import StepsWithoutContacts

    return StepsWithoutContacts


def test_they_fly_as_without_contact_and_their_matrix_is_kept(monkeypatch):
    made, solve = [], untouched().solve

    def counted(self, contacts, request):
        found = solve(self, contacts, request)
        made.append(found.answer.factorisations)
        return found

    monkeypatch.setattr(untouched(), "solve", counted)
    alone = nmm.run(nmm.parse_scene(TEXT))
    with_contact = nmm.run(nmm.parse_scene(TEXT + "[contact]\n"))
    assert len(made) >= 40
    # Once for each length of steps, which differ by rounding at the ends of the run.
    assert sum(made) <= 3
    # the same equations, in another order of their sums
    np.testing.assert_allclose(with_contact.displacement, alone.displacement, rtol=0, atol=1e-12)
