"""A belt of blocks on springs round a drum slips at the ratio of forces of its closed form.

A block of the chain on its own facet, pulled along the chords to its neighbours, slips at
``(1 + mu tan(d/2)) / (1 - mu tan(d/2))`` with the angle ``d`` of a facet; n of them at its n-th
power, which is Euler and Eytelwein's ``exp(mu pi)`` in the limit.
"""

import numpy as np
import pytest

import nmm

HIGH, HOLD = 0.04, 1e3
HEAD = """
plane = "strain"
[materials.stiff]
young_modulus = 1e9
poisson_ratio = 0.0
[interfaces.rough]
friction_angle = {friction}
[contact]
[loading]
scaled = ["pull"]
until = {until}
[formulation.contact]
enforcement = "{enforcement}"
"""


def axes(angle):
    """Normal and tangent of a facet."""
    return np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])


def block(name, ring):
    return {"name": name, "material": "stiff", "vertices": np.asarray(ring).tolist()}


def belt(n, friction, until, enforcement):
    """Half a turn of n blocks on n facets of a drum of 1 m, held by 1 kN and pulled by more."""
    import tomllib

    turn = np.pi / n
    made = tomllib.loads(
        HEAD.format(friction=float(np.arctan(friction)), until=until, enforcement=enforcement)
    )
    rim = [axes((k - 0.5) * turn)[0] / np.cos(turn / 2) for k in range(n + 1)]
    made["blocks"] = [block("drum", [*rim, (rim[-1][0], -0.8), (rim[0][0], -0.8)])]
    middles, half = [], np.tan(turn / 2) / 2
    for k in range(n):
        normal, along = axes(k * turn)
        low = [normal + side * half * along for side in (-1, 1)]
        high = [one + HIGH * normal for one in low]
        made["blocks"].append(block(f"b{k}", [low[0], high[0], high[1], low[1]]))
        middles.append((normal * (1 + HIGH / 2)).tolist())
    made["springs"] = [
        {
            "name": f"s{k}",
            "points": [middles[k], middles[k + 1]],
            "blocks": [f"b{k}", f"b{k + 1}"],
            "stiffness": 1e8,
        }
        for k in range(n - 1)
    ]
    back, on = -axes(-turn / 2)[1], axes((n - 0.5) * turn)[1]
    made["loads"] = [
        {"name": name, "kind": "point", "point": middles[at], "block": f"b{at}", "force": force}
        for name, at, force in (
            ("hold", 0, (HOLD * back).tolist()),
            ("slack", n - 1, (HOLD * on).tolist()),
            ("pull", n - 1, (HOLD * on).tolist()),
        )
    ]
    made["supports"] = [{"name": "held", "block": "drum", "fix": ["x", "y"]}]
    return nmm.Scene.model_validate(made)


@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize(("n", "friction"), [(6, 0.3), (12, 0.2)])
def test_a_belt_holds_below_the_closed_ratio_and_slips_above_it(n, friction, enforcement):
    tangent = friction * np.tan(np.pi / n / 2)
    limit = ((1 + tangent) / (1 - tangent)) ** n - 1
    moved = []
    for share in (0.99, 1.01):
        run = nmm.run(belt(n, friction, float(share * limit), enforcement))
        moved.append(np.abs(run.displacement).max())
    # Springs give by 2e3 N / 1e8 N/m at most each; what slips goes on until it turns the chords.
    assert moved[0] < 2e-5 * n
    assert moved[1] > 1e-3
