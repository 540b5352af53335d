"""Processor seconds of the Kitoh beam to failure, 130 and 455 blocks, by phase, in one run.

python benchmarks/beam.py
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

from pathlib import Path
from time import process_time

import nmm

SCENES = Path(__file__).parents[1] / "examples" / "kitoh_beam"
PHASES = ("covers", "effects", "search", "assembly", "solve", "update", "rest")


def measure(blocks: int) -> tuple[float, nmm.Run]:
    """Run one beam to its failure load, without the motion after it."""
    text = (SCENES / f"kitoh_{blocks}.toml").read_text()
    scene = nmm.parse_scene(text.replace("motion_after_failure", "# motion_after_failure"))
    started = process_time()
    run = nmm.run(scene)
    return process_time() - started, run


def main() -> dict[int, float]:
    """Print the table; return processor seconds by number of blocks."""
    measure(130)  # loads compiled code
    print("| blocks | unknowns | failure, kN | steps | passes | processor s | share by phase |")
    print("|---|---|---|---|---|---|---|")
    found = {}
    for blocks in (130, 455):
        seconds, run = measure(blocks)
        one, found[blocks] = run.summary, seconds
        wall = sum(one.seconds.values())
        shares = ", ".join(f"{p} {one.seconds.get(p, 0) / wall:.0%}" for p in PHASES)
        load = (one.failure_load or 0.0) / 1e3
        print(
            f"| {blocks} | {one.unknowns} | {load:.2f} | {one.steps} | {one.passes} | "
            f"{seconds:.2f} | {shares} |"
        )
    ratio = found[455] / found[130]
    print(f"\n455 blocks cost {ratio:.1f} times 130 blocks, for 3.5 times the unknowns")
    return found


if __name__ == "__main__":
    main()
