"""What effects cost that a scene names and that do nothing in it: a page of ratios.

python benchmarks/effects.py             # measure all and print the page
python benchmarks/effects.py cable heat  # those rows alone whose name has one of these words

Runs without and with the effect alternate in one process, so that other work on the machine slows
both. A ratio is that of the least processor times of one thread, over the whole run but for what is
compiled once.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from time import process_time

from idle_effects import IDLE, Idle

from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.scene.model import Scene
from nmm.stepping.prepare import prepare

STEPS, ROUNDS = 40, 3
"""Steps of a run, and runs of each scene."""


@dataclass(frozen=True)
class IdleCost:
    """An idle effect measured.

    Attributes
    ----------
    name
        Of its row.
    seconds
        Least processor time of the run without it (s).
    making, running
        Ratios of the scene with it to that without: until it is ready, and of its run.
    """

    name: str
    seconds: float
    making: float
    running: float


def measured(name: str, idle: Idle, rounds: int = ROUNDS) -> IdleCost:
    """Run both scenes of an idle effect in turn."""
    scenes = idle.scenes(STEPS)
    times = [[seconds(scene) for scene in scenes] for _ in range(rounds)]
    (made, ran), (made_idle, ran_idle) = (
        [min(row[scene][part] for row in times) for part in (0, 1)] for scene in (0, 1)
    )
    return IdleCost(name, ran, made_idle / made, ran_idle / ran)


def seconds(scene: Scene) -> tuple[float, float]:
    """Return the processor time until a run is ready, and that of the run (s)."""
    begun = process_time()
    made = prepare(scene, scene.formulation or Formulation())
    ready, memory = process_time(), MemorySink()
    made.run([memory], lambda share, text: None)
    assert memory.summary.status == "converged", memory.summary.sentence
    return ready - begun, process_time() - ready


HEAD = "| idle | run without it (s) | run | until it begins |\n|---|---|---|---|"


def row(cost: IdleCost) -> str:
    """Return a row of the table of the page."""
    shown = f"{cost.seconds:.2f} | {cost.running:.2f} | {cost.making:.2f}"
    return f"| {cost.name} | {shown} |"


def main(words: list[str], say: Callable[[str], object] = print) -> None:
    """Measure the rows whose names have one of the words, all without any."""
    say(HEAD)
    for name, idle in IDLE.items():
        if not words or any(word in name for word in words):
            say(row(measured(name, idle)))


if __name__ == "__main__":
    main(sys.argv[1:])
