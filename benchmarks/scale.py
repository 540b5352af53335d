"""Walls and piles of 10 000 and 100 000 blocks: seconds a step and the peak of memory.

python benchmarks/scale.py wall 10000 30  # scene, blocks, steps of a millisecond
python benchmarks/scale.py pile 100000 3 1  # and the normal penalty (E), else the default's 10

One run a process, so that the peak is its own; `bench_scale.py` starts those of 10 000. *Before*
are processor seconds from a scene in memory to the first step. Every step counts, the dear first
ones too; *later* leaves the first three out.
"""

import resource
import sys
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from json import dumps
from time import process_time

from whole_scenes import SCENES

from nmm.formulation import Formulation
from nmm.results.frame import Frame, Topology
from nmm.results.summary import Summary
from nmm.solvers.threads import OneThread
from nmm.stepping.prepare import prepare

STEP = 1e-3


@dataclass(frozen=True)
class Scaled:
    """A run: milliseconds of processor time a step, and memory."""

    scene: str
    blocks: int
    penalty: float
    steps: int
    before_s: float
    ms_a_step: float
    later_ms_a_step: float
    passes: float
    peak_mb: float
    ended: str


class Counting:
    """Sink that keeps the instant and the passes of each step, and no frame."""

    def __init__(self) -> None:
        self.at: list[float] = []
        self.passes: list[float] = []
        self.summary = Summary()

    def begin(self, topology: Topology) -> None:
        """Keep nothing."""

    def frame(self, frame: Frame) -> None:
        """Keep nothing."""

    def row(self, values: Mapping[str, float]) -> None:
        """Count a step."""
        self.at.append(process_time())
        self.passes.append(values["passes"])

    def finish(self, summary: Summary) -> None:
        """Keep the verdict."""
        self.summary = summary


def scaled(scene: str, blocks: int, steps: int, penalty: float = 10.0) -> Scaled:
    """Run."""
    given = {"contact": {"normal_penalty": penalty}, "integrator": {"step": STEP}}
    made, begun = SCENES[scene](blocks, steps * STEP), process_time()
    ready = prepare(made, Formulation.model_validate(given))
    first, sink = process_time(), Counting()
    with OneThread():
        ready.run([sink], lambda share, text: None)
    taken = max(len(sink.at), 1)
    rest = (sink.at[-1] - sink.at[2]) / (taken - 3) if taken > 3 else float("nan")
    return Scaled(
        scene,
        sink.summary.blocks,
        penalty,
        taken,
        first - begun,
        1e3 * (sink.at[-1] - first) / taken,
        1e3 * rest,
        sum(sink.passes) / taken,
        resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        sink.summary.status,
    )


if __name__ == "__main__":
    kind, *numbers = sys.argv[1:]
    print(dumps(asdict(scaled(kind, *(int(one) for one in numbers)))))
