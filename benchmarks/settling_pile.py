"""A pile of loose Voronoi blocks falls together in a box and comes to rest.

    python benchmarks/settling_pile.py --blocks 1000 --step 4e-3 --duration 3

The blocks, 1 m2 each, start apart by gaps of ``--gap`` of their size, so that all of them meet
anew. Measured: whether every step converged, the largest rise of the total energy over its lowest
value before (relative to the work of the weight), motion left at the end, blocks outside the box,
and overlap of the blocks where they lie at the end.
"""

import argparse
import json
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

from pathlib import Path
from time import process_time

import numpy as np
import shapely
from records import stamp
from whole_scenes import BOX, THICK, pile

import nmm
from nmm.formulation import Formulation

RAW = argparse.RawDescriptionHelpFormatter


def energy_rise(history: dict[str, np.ndarray]) -> float:
    """Largest rise of the total energy over its lowest value before, over the weight's work."""
    stored = sum(history[f"{kind}_energy"] for kind in ("kinetic", "strain", "contact"))
    total = stored - history["external_work"]
    rise = total - np.minimum.accumulate(total)
    return float(rise.max() / np.abs(history["external_work"]).max())


def overlap(shapes: np.ndarray) -> float:
    """Largest area that two blocks share, over the smaller of their areas."""
    first, second = shapely.STRtree(shapes).query(shapes)
    first, second = first[first < second], second[first < second]
    shared = shapely.area(shapely.intersection(shapes[first], shapes[second]))
    area = shapely.area(shapes)
    return float((shared / np.minimum(area[first], area[second])).max())


def measure(options: argparse.Namespace) -> dict[str, float | str]:
    """Run one pile; return what is recorded of it."""
    height = options.height or options.blocks**0.5
    scene = pile(options.blocks, options.duration, height=height, gap=options.gap)
    integrator = {"type": "shi", "step": options.step, "kinetic_factor": options.kinetic_factor}
    contact = {"enforcement": options.enforcement, "normal_penalty": options.penalty}
    formulation = Formulation.model_validate({"integrator": integrator, "contact": contact})
    started = process_time()
    run = nmm.run(scene, formulation, progress=_say if options.progress else None)
    seconds = process_time() - started
    history, one = run.history, run.summary
    shapes = np.array(run.manifold.elements.with_points(run.frames[-1].points).to_shapely())
    box = shapely.box(0.0, 0.0, options.blocks / height, 1.2 * height).buffer(THICK / 10)
    return {
        "blocks": options.blocks,
        "height": height,
        "enforcement": options.enforcement,
        "penalty": options.penalty,
        "step": options.step,
        "kinetic_factor": options.kinetic_factor,
        "duration": float(history["time"][-1]),
        "status": one.status,
        "sentence": one.sentence,
        "steps": one.steps,
        "contacts": int(max(sum(history[s] for s in ("stick", "slide")))),
        "passes_a_step": one.passes / one.steps,
        "seconds_a_step": seconds / one.steps,
        "energy_rise": energy_rise(history),
        "kinetic_energy": float(history["kinetic_energy"][-1] / history["kinetic_energy"].max()),
        "largest_penetration": float(history["penetration"].max()),
        "largest_overlap": overlap(shapes),
        "lost": int((~shapely.covered_by(shapes[len(BOX) :], box)).sum()),
        "residual": float(history["residual"].max()),
        **stamp(),
    }


def _say(share: float, text: str) -> None:
    print(f"\r{share:6.1%} {text}", end="", flush=True)


def main() -> None:
    """Measure one pile, print the record and append it to a file."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=RAW)
    parser.add_argument("--blocks", type=int, default=100)
    parser.add_argument("--height", type=float, help="m; as high as wide by default")
    parser.add_argument("--step", type=float, default=4e-3, help="s")
    parser.add_argument("--duration", type=float, default=2.0, help="s")
    parser.add_argument("--gap", type=float, default=0.02, help="share of a block's size")
    parser.add_argument("--enforcement", default="penalty")
    parser.add_argument("--penalty", type=float, default=10.0, help="times E")
    parser.add_argument("--kinetic-factor", type=float, default=1.0, help="of Shi's integrator")
    parser.add_argument("--records", type=Path, help="file to append the record to, as JSON lines")
    parser.add_argument("--progress", action="store_true")
    options = parser.parse_args()
    record = measure(options)
    print("\n".join(f"{name:20} {value}" for name, value in record.items()))
    if options.records:
        with options.records.open("a") as file:
            file.write(json.dumps(record) + "\n")


if __name__ == "__main__":
    main()
