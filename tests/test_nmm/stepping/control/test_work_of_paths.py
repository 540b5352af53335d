"""What loads do along a path and what its bonds take hang on no step."""

import pytest

import nmm
from nmm.scene.read import parse_scene
from nmm.verification import text


def pulled(increment: float) -> "nmm.Run":
    """Two stiff squares of 1 m are pulled 3 mm apart; their joint bears 100 kPa, then softens."""
    bond = {
        "bonded": True,
        "cohesion": 1e6,
        "tensile_strength": 1e5,
        "fracture_energy": 100.0,
    }
    held = '[[supports]]\nname = "{}"\nsegment = [[{}, 0], [{}, 1]]\nfix = {}\n'
    control = (
        '[loading]\nuntil = "failure"\n[loading.control]\ntype = "displacement"\nfall = 0.0\n'
        f'monitors = ["end"]\ndirection = [1, 0]\nincrement = {increment}\nend = 3e-3\n'
    )
    tables = [
        text.material("rock", 1e12, 0.0),
        text.interface("joint", 30.0, more=bond) + 'law = "bilinear_softening"\n',
        text.box("a", (0, 0), (1, 1)),
        text.box("b", (1, 0), (1, 1)),
        held.format("left", 0, 0, '["x", "y"]'),
        held.format("right", 2, 2, '["y"]'),
        '[[loads]]\nname = "pull"\nkind = "edge"\nsegment = [[2, 0], [2, 1]]\n'
        "traction = [1e5, 0]\n",
        text.monitor("end", (2, 0.5), "b"),
        control,
    ]
    return nmm.run(parse_scene(text.scene('plane = "strain"\n[contact]\n', tables)))


@pytest.mark.parametrize("increment", [1e-3, 0.7e-3, 0.1e-3])
def test_work_is_the_area_under_the_curve_whatever_the_steps(increment):
    """Petersson's chords to 0.8 and 3.6 mm: 0.6 / 8.4 of the strength is left at 3 mm."""
    history = pulled(increment).history
    left = 0.6 / 8.4
    area = 1e5 * (0.8e-3 * (1 + 1 / 3) / 2 + 2.2e-3 * (1 / 3 + left) / 2)
    # Squares stretch by 2e-7 m; the knee lies within steps of 1 and 0.7 mm.
    assert history["external_work"][-1] == pytest.approx(area, rel=1e-4)
    taken = area - 1e5 * left * 3e-3 / 2
    assert history["friction_loss"][-1] == pytest.approx(taken, rel=1e-4)
