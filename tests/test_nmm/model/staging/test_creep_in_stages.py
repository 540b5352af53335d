"""Matter that creeps over stages: time passes in equilibrium, loads and blocks come and go."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing.resumed.stopping import check_goes_on
from nmm.testing.scenes import salt_block

G_K, ETA_K = 2e9, 2e14
BULK, SHEAR = 20e9 / 3, 4e9

SALT = (
    salt_block("{law}", "{constants}", {"first": -1, "second": -2})
    + """[[stages]]
name = "pressed"
loads = ["first"]
duration = 1e5
[[stages]]
name = "more"
loads = ["first", "second"]
duration = 5e4
{cover}
[[stages]]
name = "let go"
loads = []
duration = 1e5
{more}
[formulation.cover]
type = "quads"
size = 0.5
degree = 1
[formulation.integrator]
step = 500.0
[formulation.supports]
method = "lagrange"
"""
)
LAWS = {
    "maxwell": f"viscosity = {4e14}",
    "burgers": f"viscosity = {4e14}\ndelayed_modulus = {G_K}\ndelayed_viscosity = {ETA_K}",
}


def compliance(law, t):
    """Settlement (m) under 1 Pa after t s, by Laplace's transform with Stehfest's weights."""
    from math import factorial, log

    if t < 0:
        return 0.0

    def transformed(s):
        shear = 1 / (1 / SHEAR + 1 / (4e14 * s))
        if law == "burgers":
            shear = 1 / (1 / SHEAR + 1 / (4e14 * s) + 1 / (G_K + ETA_K * s))
        # 1/E' of plane strain, (1 - nu^2) / E, in bulk and shear moduli.
        return (3 * BULK + 4 * shear) / (4 * shear * (3 * BULK + shear)) / s

    n, total = 14, 0.0
    for i in range(1, n + 1):
        weight = sum(
            k ** (n // 2)
            * factorial(2 * k)
            / (
                factorial(n // 2 - k)
                * factorial(k)
                * factorial(k - 1)
                * factorial(i - k)
                * factorial(2 * k - i)
            )
            for k in range((i + 1) // 2, min(i, n // 2) + 1)
        )
        total += (-1) ** (i + n // 2) * weight * transformed(i * log(2) / max(t, 1e-6))
    return total * log(2) / max(t, 1e-6)


def salt(law="maxwell", cover="", more=""):
    return nmm.parse_scene(SALT.format(law=law, constants=LAWS[law], cover=cover, more=more))


@pytest.mark.parametrize("cover", ["", "cover = { size = 0.3 }"])
@pytest.mark.parametrize("law", LAWS)
def test_settlements_of_stages_superpose(law, cover):
    run = nmm.run(salt(law, cover))
    assert run.summary.status == "converged", run.summary.sentence
    found = run.history["monitor:foot:uy"] - run.history["monitor:top:uy"]
    times = run.history["time"]
    for t in (0.0, 5e4, 1e5, 1.2e5, 1.5e5, 2e5, 2.5e5):
        now = found[np.isclose(times, t, atol=1.0)][-1]
        loads = ((1e6, 0.0), (2e6, 1e5), (-3e6, 1.5e5))
        # At the very time of a change the loads have come on, and no time has passed.
        expected = sum(p * compliance(law, t - at) for p, at in loads)
        assert now == pytest.approx(expected, rel=3e-3), t


def test_a_run_that_is_stopped_goes_on_bit_by_bit(tmp_path):
    scene = salt("burgers", "cover = { size = 0.3 }", "[output.checkpoint]\nevery_steps = 20\n")
    check_goes_on(scene, tmp_path, 250)


def test_two_clocks_are_refused_by_line():
    text = SALT.format(law="maxwell", constants=LAWS["maxwell"], cover="", more="")
    hot = "conductivity = 2.0\nheat_capacity = 800\ndensity = 2000\n[[blocks]]"
    text = text.replace("[[blocks]]", hot, 1)
    text += '[heat]\ntransient = true\nduration = "1 h"\n'
    with pytest.raises(SceneError, match=r"stages.0.duration: duration with transient \[heat\]"):
        nmm.parse_scene(text)
