"""A run that is dropped is freed there and then, with all of its model, but for its results."""

import gc
import tomllib
from collections.abc import Callable
from typing import Any

import pytest

import nmm
from covers.approximation.manifold import Manifold
from nmm.assembly.model import Model
from nmm.scene import build_scene
from nmm.stepping.step.stepper import Stepper
from nmm.testing.scenes import STACKED, biaxial_test
from nmm.verification.hard.spoilt.mutations import sound_files

TRIANGLES = '[formulation.cover]\ntype = "triangles"\nsize = 0.5\n'


def sound(name: str) -> str:
    return sound_files()[name][1]


# Contact in statics and in time, triangles, cracks, matter that yields, bars, and fields that
# effects tell one another of.
SCENES: dict[str, Callable[[], str]] = {
    "static blocks in contact": lambda: STACKED,
    "blocks in time": lambda: sound("dynamic"),
    "cohesive zones": lambda: sound("zones"),
    "a path past the peak": lambda: sound("softening"),
    "yielding triangles": lambda: biaxial_test(0.0, TRIANGLES),
    "consolidation": lambda: sound("consolidating"),
    "joints under water": lambda: sound("joints under water"),
    "heat": lambda: sound("heated"),
    "members": lambda: sound("members"),
}
# All others take less than a second each.
SLOW = ("heat", "members")


def modelled() -> list[Any]:
    """Return the models, manifolds and steppers that are alive."""
    return [one for one in gc.get_objects() if isinstance(one, Model | Manifold | Stepper)]


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=[pytest.mark.slow] * (kind in SLOW)) for kind in SCENES]
)
def test_nothing_of_a_dropped_run_waits_for_a_search_for_cycles(kind: str) -> None:
    scene = build_scene(tomllib.loads(SCENES[kind]()), kind)
    gc.collect()
    before = modelled()
    gc.disable()
    try:
        run = nmm.run(scene)
        kept = run.frames, run.history, run.summary
        del run
        assert len(modelled()) == len(before), kept
    finally:
        gc.enable()
