"""Which runs factorise by compiled code: those whose steps pay for the import of the compiler."""

import pytest

from nmm.formulation import Formulation
from nmm.scene.model import Scene
from nmm.stepping.posed import pose


def bar(steps: int, **formulation):
    """Elastic bar held at one end, steps of 1 ms; 2 700 unknowns."""
    scene = Scene.model_validate(
        {
            "title": "bar",
            "plane": "strain",
            "duration": steps * 1e-3,
            "materials": {"rock": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2000.0}},
            "supports": [{"name": "end", "segment": [[0, 0], [0, 1]], "fix": ["x", "y"]}],
            "blocks": [{"material": "rock", "vertices": [[0, 0], [4, 0], [4, 1], [0, 1]]}],
            "gravity": {},
            "inertia": {},
        }
    )
    cover = {"type": "triangles", "size": 0.1}
    return pose(scene, Formulation.model_validate({"cover": cover, **formulation}))


@pytest.mark.parametrize(("steps", "compiled"), [(10, False), (100, True)])
def test_many_steps_with_matrices_of_their_own_pay_for_the_compiler(steps, compiled):
    assert bar(steps).solver.compiled is compiled


def test_steps_with_one_matrix_for_all_do_not_pay_for_the_compiler():
    assert not bar(100, rotation={"update": "small"}).solver.compiled
