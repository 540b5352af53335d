"""Random scenes with seldom keys: what is added joins whole scenes, and is in no other class."""

from functools import cache

from nmm.verification.hard.generators.scenes.scenes import Scenes
from nmm.verification.hard.generators.seldom.keys import SeldomKeys, joined

SEEDS = range(120)
NAMED = ("materials", "interfaces", "splitting", "records")


def paths(table, place=()):
    """Yield the path of every key of a scene, tables with names of their own as one."""
    for key, value in table.items():
        path = place if place and place[-1] in NAMED and isinstance(value, dict) else (*place, key)
        yield path
        for one in value if isinstance(value, list) else [value]:
            if isinstance(one, dict):
                yield from paths(one, path)


@cache
def cases(kind):
    return [case for seed in SEEDS for case in kind().cases(seed)]


def keys_of(kind):
    return {path for case in cases(kind) for path in paths(case.scene)}


def test_seldom_keys_are_those_that_no_other_random_scene_has():
    # A thousand seeds add 118 keys of docs/scene.md and docs/formulation.md.
    assert len(keys_of(SeldomKeys) - keys_of(Scenes)) > 60


def test_the_same_seed_gives_the_same_scene():
    first, second = (next(iter(SeldomKeys().cases(7))) for _ in range(2))
    assert first.label == second.label
    assert first.scene == second.scene


def test_a_list_that_is_added_grows_unless_it_takes_the_place_of_the_other():
    scene = {"loads": [1], "blocks": [1]}
    assert joined(scene, {"loads": [2], "blocks!": [3]}) == {"loads": [1, 2], "blocks": [3]}
