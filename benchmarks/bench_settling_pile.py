"""A pile of loose Voronoi blocks falls together in a box and comes to rest.

The blocks, 1 m2 each, start apart by gaps of 2 % of their size, so that all of them meet anew.
*Energy rise*: of the total energy over its lowest value before, relative to the work of the
weight. *Overlap*: of two blocks where they lie at the end, over the smaller of them.
"""

from typing import Any

import numpy as np
import shapely
from whole_scenes import BOX, THICK, pile

import nmm
from nmm.formulation import Formulation

BLOCKS, STEP, DURATION = 100, 4e-3, 2.0


def settled() -> nmm.Run:
    """Run the pile with the default enforcement."""
    formulation = Formulation.model_validate({"integrator": {"type": "shi", "step": STEP}})
    return nmm.run(pile(BLOCKS, DURATION, gap=0.02), formulation)


def test_settling_pile(benchmark: Any) -> None:
    benchmark.group = f"loose pile of {BLOCKS} comes to rest"
    run = benchmark.pedantic(settled, rounds=1)
    kinetic = run.history["kinetic_energy"]
    shapes = np.array(run.manifold.elements.with_points(run.frames[-1].points).to_shapely())
    side = BLOCKS**0.5
    box = shapely.box(0.0, 0.0, side, 1.2 * side).buffer(THICK / 10)
    benchmark.extra_info |= {
        "blocks": BLOCKS,
        "steps": run.summary.steps,
        "energy rise": energy_rise(run.history),
        "motion left": float(kinetic[-1] / kinetic.max()),
        "overlap": overlap(shapes),
        "lost": int((~shapely.covered_by(shapes[len(BOX) :], box)).sum()),
        "ended": run.summary.sentence,
    }


def energy_rise(history: dict[str, np.ndarray]) -> float:
    """Return the largest rise of the total energy, over the work of the weight."""
    stored = sum(history[f"{kind}_energy"] for kind in ("kinetic", "strain", "contact"))
    total = stored - history["external_work"]
    rise = total - np.minimum.accumulate(total)
    return float(rise.max() / np.abs(history["external_work"]).max())


def overlap(shapes: np.ndarray) -> float:
    """Return the largest area that two blocks share, over the smaller of their areas."""
    first, second = shapely.STRtree(shapes).query(shapes)
    first, second = first[first < second], second[first < second]
    shared = shapely.area(shapely.intersection(shapes[first], shapes[second]))
    area = shapely.area(shapes)
    return float((shared / np.minimum(area[first], area[second])).max())
