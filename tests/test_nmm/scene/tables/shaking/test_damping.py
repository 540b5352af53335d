"""Faults of `[damping]`, told by line with what was expected."""

import pytest

import nmm
from nmm.errors import SceneError

SCENE = """plane = "strain"
duration = "1 s"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "stone"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[inertia]
[damping]
"""


def faults(text):
    with pytest.raises(SceneError) as caught:
        nmm.parse_scene(text, "s.toml")
    return str(caught.value)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ("", "nothing: expected mass, stiffness, ratios or local"),
        ("local = 1.0", "s.toml:13: damping.local: 1.0"),
        ("mass = -1", "s.toml:13: damping.mass: -1"),
        ("ratios = [0.05, 0.05]", "no frequencies: expected ratios with frequencies"),
        ("mass = 1\nratios = [0.05, 0.05]\nfrequencies = [2, 10]", "both: expected mass"),
        ("ratios = [5, 5]\nfrequencies = [2, 10]", "ratios from 0 to 1"),
        ("ratios = [0.05, 0.05]\nfrequencies = [2, 2]", "two different frequencies"),
        ("ratios = [0.05, 0.5]\nfrequencies = [2, 10]", "0.2 to 5 times the first"),
        ('mass = 1\nground = "bas"', 's.toml:14: damping.ground: "bas": expected the name of a'),
        ('local = 0.1\nground = "bas"', "ground without mass"),
        ('ratios = [0.05, 0.05]\nfrequencies = ["12 rad/s", "2 Hz"]', "no angle a second"),
    ],
)
def test_wrong_damping_is_told_by_line(keys, said):
    told = faults(SCENE + keys)
    assert told.startswith("s.toml:")
    assert said in told


def test_damping_without_inertia_is_refused():
    told = faults(SCENE.replace("[inertia]\n", "").replace('duration = "1 s"\n', "") + "mass = 1")
    assert "no [inertia]: expected a dynamic scene" in told
