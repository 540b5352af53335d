"""Islands solved apart: as if each were a scene of its own, and woken by all that reaches them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nmm
from nmm.contact.iteration import apart
from nmm.formulation import Formulation
from nmm.scene.model import Scene
from nmm.testing.resumed.stopping import check_goes_on

STEP = 1e-3
NEAR = 2e-7
"""Steps settle to 1e-8 of their forces: over some thirty of them, of the path of a block."""


def box(name: str, x: float, y: float, wide: float = 1.0, high: float = 0.5) -> dict[str, Any]:
    ring = [[x, y], [x + wide, y], [x + wide, y + high], [x, y + high]]
    return {"name": name, "material": "rock", "vertices": ring}


def tower(name: str, x: float, courses: int = 12) -> list[dict[str, Any]]:
    """Blocks on top of each other, each a little aside of the one below."""
    aside = [0.1 * (course % 2) for course in range(courses)]
    return [box(f"{name}{k}", x + aside[k], 0.5 * k) for k in range(courses)]


def ground(name: str, x: float) -> dict[str, Any]:
    return box(name, x - 1, -0.5, wide=3.0)


def scene(blocks: list[dict[str, Any]], steps: int = 25, **more: Any) -> Scene:
    lasting = {} if "stages" in more else {"duration": steps * STEP}
    held = [one["name"] for one in blocks if "ground" in one["name"]]
    return Scene.model_validate(
        {
            "title": "towers",
            "plane": "strain",
            "materials": {"rock": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2000.0}},
            "interfaces": {"dry": {"friction_angle": float(np.arctan(0.6))}},
            "blocks": blocks,
            "supports": [{"name": name, "block": name, "fix": ["x", "y"]} for name in held],
            "gravity": {},
            "inertia": {},
            "contact": {},
        }
        | lasting
        | more
    )


APART = [ground("ground", 0.0), *tower("a", 0.0), ground("far ground", 40.0), *tower("b", 40.0, 9)]
"""Two towers that share nothing."""
SHARED = [box("ground", -2.0, -0.5, wide=30.0), *tower("a", 0.0), *tower("b", 10.0, 9)]
"""The same on one ground."""
DOWN = {"initial_velocities": [{"block": "a11", "velocity": [0.5, -0.3]}]}


def formulation(rounds: int = 4) -> Formulation:
    """Islands of ten blocks are solved alone."""
    options = {"iterations": {"islands": {"rounds": rounds, "alone": 60}}}
    given = {"integrator": {"step": STEP}, "contact": {"options": options}}
    return Formulation.model_validate(given)


def moved(given: Scene, rounds: int = 4) -> dict[str, np.ndarray]:
    """How far the vertices (4, 2) of each block have come at the end, by name."""
    run = nmm.run(given, formulation(rounds))
    assert run.summary.status == "converged", run.summary.sentence
    end = run.frames[-1].points
    start = next(one.points for one in run.frames if len(one.points) == len(end))
    gone = {name for stage in given.stages for name in stage.remove}
    names = [block.name for block in given.blocks if block.name not in gone]
    return dict(zip(names, (end - start).reshape(-1, 4, 2), strict=True))


def check_alike(found: dict[str, np.ndarray], expected: dict[str, np.ndarray]) -> None:
    size = max(np.abs(way).max() for way in expected.values())
    for name, way in expected.items():
        assert np.abs(found[name] - way).max() <= NEAR * size, name


@pytest.fixture
def trail(monkeypatch: pytest.MonkeyPatch) -> list[np.ndarray]:
    """Names the blocks solved in each solution: numbers of bodies, one array a solution."""
    kept: list[np.ndarray] = []
    part_of = apart.part_of

    def noted(springs: Any, unknowns: np.ndarray, *rest: Any) -> Any:
        kept.append(np.unique(unknowns // 6))
        return part_of(springs, unknowns, *rest)

    monkeypatch.setattr(apart, "part_of", noted)
    return kept


def test_islands_move_as_scenes_of_their_own() -> None:
    both = moved(scene(APART, **DOWN))
    first, second = APART[:13], APART[13:]
    check_alike(both, moved(scene(first, **DOWN)) | moved(scene(second)))


@pytest.mark.parametrize("blocks", [APART, SHARED], ids=["apart", "on one ground"])
def test_islands_solved_apart_move_as_solved_together(
    blocks: list[dict[str, Any]], trail: list[np.ndarray]
) -> None:
    found = moved(scene(blocks, **DOWN))
    assert len(trail) > 20
    check_alike(found, moved(scene(blocks, **DOWN), rounds=0))


def test_the_order_of_blocks_does_not_matter() -> None:
    order = np.random.default_rng(3).permutation(len(SHARED))
    shuffled = [SHARED[k] for k in order]
    check_alike(moved(scene(shuffled, **DOWN)), moved(scene(SHARED, **DOWN)))


def settled(steps: int, **more: Any) -> dict[str, Any]:
    """Stages of a scene whose towers come to rest before its clock starts."""
    motion = {"name": "motion", "duration": steps * STEP} | more
    return {"damping": {"mass": 200.0}, "stages": [{"name": "rest", "loads": []}, motion]}


def push(block: str, x: float, y: float, history: list[list[float]]) -> dict[str, Any]:
    load = {"kind": "point", "name": f"push {block}", "block": block, "point": [x, y]}
    return load | {"force": [-2e3, 0.0], "history": history}


QUIET = 50
"""Steps in which what statics leaves, 1e-6 of the forces, dies away below the tolerance."""
SHAKEN = push("a11", 1.1, 5.75, [[5 * k * STEP, float(k % 2)] for k in range(40)])
"""Keeps the first tower in motion."""
LATER = push("b8", 41.0, 4.25, [[0.0, 0.0], [QUIET * STEP, 0.0], [(QUIET + 1) * STEP, 1.0]])


def test_an_island_at_rest_is_left_alone_while_another_moves(trail: list[np.ndarray]) -> None:
    loads = ["push a11"]
    moved(scene(APART, loads=[SHAKEN], **settled(QUIET, loads=loads)))
    others = [bool((part > 13).any()) for part in trail]
    # It is solved now and then, as what its last solution left adds up beyond the tolerance.
    assert sum(others[-20:]) <= 10
    assert len(trail) > QUIET


def test_an_island_is_woken_by_a_load_that_begins(trail: list[np.ndarray]) -> None:
    both = ["push a11", "push b8"]
    given = scene(APART, loads=[SHAKEN, LATER], **settled(QUIET + 10, loads=both))
    found = moved(given)
    assert all((part > 13).any() for part in trail[-19::2])
    check_alike(found, moved(given, rounds=0))


def test_an_island_is_woken_by_an_impact() -> None:
    stone = box("stone", 40.0, 4.505)
    dropped = {"initial_velocities": [{"block": "stone", "velocity": [0.0, -1.0]}]}
    first = {"name": "rest", "blocks": [one["name"] for one in APART]}
    then = {"name": "motion", "add": ["stone"], "duration": 12 * STEP}
    given = scene([*APART, stone], **dropped, stages=[first, then])
    found = moved(given)
    check_alike(found, moved(given, rounds=0))
    assert np.abs(found["b8"]).max() > 1e-5


def test_an_island_is_woken_by_a_stage_that_takes_a_block_away() -> None:
    given = scene(APART, **settled(12, remove=["b7"]))
    found = moved(given)
    check_alike(found, moved(given, rounds=0))


def test_what_is_kept_of_islands_is_dropped_with_the_workspace() -> None:
    run = nmm.run(scene(SHARED, steps=4, **DOWN), formulation())
    memory = run.stepper.plan.contact.solver.memory
    assert memory.apart
    run.stepper.forget()
    assert not memory.apart


def test_a_run_of_islands_goes_on_to_the_same_bytes(tmp_path: Path) -> None:
    often = {"output": {"checkpoint": {"every_steps": 3}}}
    given = scene(SHARED, steps=8, **DOWN, **often)
    check_goes_on(given, tmp_path, 5, formulation())
