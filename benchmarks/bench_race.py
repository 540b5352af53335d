"""Whole runs raced: every step counts, the first as the last; seconds beside counted work.

*Drift*: how far the block that moved most is from where it began. *Overlap*: the sum of the areas
that two blocks share at the end. *Force error*: largest out-of-balance force of a step, relative.
*Energy*: work done less energy stored and lost, over the largest of them. Walls and piles are
raced by pymunk too where it is installed. `make bench` runs them among all others,
`pytest benchmarks/bench_race.py -k "wall and 100"` a few.
"""

from typing import Any

import numpy as np
import pytest
import shapely
from counted_work import raced, run
from race_peers import Pymunk
from race_scenes import RACES

from nmm.stepping.prepare import prepare


def shared_area(rings: list[np.ndarray]) -> float:
    """Return the sum of the areas (m2) that two polygons share."""
    shapes = shapely.polygons(rings) if len({len(r) for r in rings}) == 1 else None
    shapes = np.array([shapely.Polygon(ring) for ring in rings]) if shapes is None else shapes
    first, second = shapely.STRtree(shapes).query(shapes)
    first, second = first[first < second], second[first < second]
    return float(shapely.area(shapely.intersection(shapes[first], shapes[second])).sum())


def drift(before: list[np.ndarray], after: list[np.ndarray]) -> float:
    """Return how far (m) the vertex that moved most is from where it was."""
    pairs = zip(before, after, strict=True)
    return float(max(np.hypot(*(new - old).T).max() for old, new in pairs))


@pytest.mark.parametrize("name", RACES)
def test_race(benchmark: Any, name: str) -> None:
    race = RACES[name]
    run(prepare(*RACES["two blocks"].made()))  # loads compiled code
    benchmark.group = name
    made = prepare(*race.made())
    start = made.stepper.model.manifold.elements
    memory = benchmark.pedantic(run, (made,), rounds=1)
    rows = memory.rows
    steps = max(len(rows), 1)
    end = start.with_points(memory.frames[-1].points)
    rings = [list(map(np.array, _rings(one))) for one in (start, end)]
    work, summary = raced(race).work, memory.summary
    benchmark.extra_info |= {
        "program": "nmm",
        "unknowns": summary.unknowns,
        "steps": len(rows),
        "ms a step": 1e3 * benchmark.stats.stats.min / steps,
        "passes": work.passes,
        "factors": work.factorisations,
        "calls": work.calls,
        "drift (m)": drift(*rings),
        "overlap (m2)": shared_area(rings[1]),
        "force error": summary.equilibrium_residual,
        "energy": summary.energy_balance,
        "ended": summary.sentence,
    }


@pytest.mark.parametrize("name", [name for name in RACES if "wall" in name or "pile" in name])
def test_race_of_a_peer(benchmark: Any, name: str) -> None:
    pytest.importorskip("pymunk")
    race = RACES[name]
    assert race.step is not None
    benchmark.group = name
    peer = Pymunk(prepare(*race.made()), race.step, race.steps)
    before = peer.rings()
    benchmark.pedantic(peer.run, rounds=1)
    after = peer.rings()
    benchmark.extra_info |= {
        "program": "pymunk",
        "unknowns": 3 * len(peer.shapes),
        "steps": race.steps,
        "ms a step": 1e3 * benchmark.stats.stats.min / race.steps,
        "passes": 0.0,
        "factors": 0.0,
        "calls": 0.0,
        "drift (m)": drift(before, after),
        "overlap (m2)": shared_area(after),
        "force error": None,
        "energy": None,
        "ended": "",
    }


def _rings(polygons: Any) -> list[np.ndarray]:
    return [np.array(one.exterior.coords)[:-1] for one in polygons.to_shapely()]
