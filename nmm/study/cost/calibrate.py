"""Measure small scenes of several kinds on this machine and fit the cost model to them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from time import process_time

import numpy as np

from nmm.formulation import Formulation
from nmm.progress import Progress
from nmm.scene import Scene, parse_scene
from nmm.study.cases.measure import machine
from nmm.study.cases.memory import added_memory
from nmm.study.cases.variants import StudyCase
from nmm.study.cost.cost_model import CostModel, MeasuredRun, fit
from nmm.study.cost.run_size import size_of

ROCK = "[materials.rock]\nyoung_modulus = 1e9\npoisson_ratio = 0.2\ndensity = 2000\n"
JOINT = "[interfaces.joint]\nfriction_angle = 0.5\n"
BEAM = (
    'title = "beam"\nplane = "stress"\n'
    + ROCK
    + '[[blocks]]\nmaterial = "rock"\nvertices = [[0, 0], [4, 0], [4, 1], [0, 1]]\n'
    '[[supports]]\nname = "wall"\nsegment = [[0, 0], [0, 1]]\nfix = ["x", "y"]\n'
    '[[loads]]\nname = "end"\nkind = "edge"\nsegment = [[4, 0], [4, 1]]\ntraction = [0, 1e3]\n'
)


@dataclass(frozen=True)
class Kind:
    """One kind of scene at a size: cells across a beam, or blocks on a side of a wall."""

    name: str
    cover: str
    degree: int
    number: int
    steps: int = 1

    @property
    def case(self) -> StudyCase:
        """What is run."""
        name = f"{self.name} {self.number}"
        if self.cover == "block":
            return StudyCase(name, wall(self.number, self.steps), _walled(self.degree))
        cover = {"type": self.cover, "degree": self.degree, "size": 1 / self.number}
        formulation = Formulation.model_validate({"cover": cover})
        return StudyCase(name, parse_scene(BEAM, "calibration"), formulation)


FITTED = (
    *(Kind("triangles 0", "triangles", 0, n) for n in (4, 8, 16, 24)),
    *(Kind("triangles 1", "triangles", 1, n) for n in (4, 8, 14)),
    *(Kind("quads 1", "quads", 1, n) for n in (4, 8, 14)),
    *(Kind("quads 2", "quads", 2, n) for n in (4, 8)),
    *(Kind("DDA wall", "block", 1, n, 20) for n in (3, 5, 8, 12)),
    *(Kind("DDA wall", "block", 1, n, 60) for n in (4, 10)),
    *(Kind("DDA 2 wall", "block", 2, n, 20) for n in (3, 6, 10)),
)
"""Scenes that the model is fitted on."""

CHECKED = (
    Kind("triangles 0", "triangles", 0, 54),
    Kind("triangles 1", "triangles", 1, 32),
    Kind("quads 1", "quads", 1, 32),
    Kind("DDA wall", "block", 1, 27, 20),
)
"""Scenes about five times larger than the largest of their kind, for `check`."""


def wall(number: int, steps: int) -> Scene:
    """Return a wall of so many square blocks a side that settles for so many steps of 1 ms."""
    blocks = [
        f'[[blocks]]\nname = "b{i}-{j}"\nmaterial = "rock"\n'
        f"vertices = [[{i}, {j}], [{i + 1}, {j}], [{i + 1}, {j + 1}], [{i}, {j + 1}]]\n"
        for i in range(number)
        for j in range(number)
    ]
    supports = [
        f'[[supports]]\nname = "h{i}"\nblock = "b{i}-0"\nfix = ["x", "y"]\n' for i in range(number)
    ]
    head = f'title = "wall"\nplane = "stress"\nduration = {steps / 1000}\n'
    head += "[gravity]\n[inertia]\n[contact]\n"
    return parse_scene(head + ROCK + JOINT + "".join(blocks + supports), "calibration")


def measured(kinds: Sequence[Kind], progress: Progress | None = None) -> Iterator[MeasuredRun]:
    """Yield size and cost of every kind, each after a warm-up and the lesser of two repeats."""
    from nmm.results.sink import MemorySink
    from nmm.stepping.prepare import prepare

    for number, kind in enumerate(kinds):
        if progress is not None:
            progress(number / len(kinds), kind.case.name)
        case = kind.case
        times, simulation = [], None
        for _ in range(3):
            began = process_time()
            simulation = prepare(case.scene, case.formulation)
            built = process_time()
            simulation.run([MemorySink()], lambda share, text: None)
            times.append((built - began, process_time() - built))
        assert simulation is not None
        size = size_of(simulation, float(kind.steps))
        preparing, running = np.min(np.array(times[1:]), axis=0)
        yield MeasuredRun(case.name, size, float(preparing), float(running), added_memory(case))


def calibrate(progress: Progress | None = None) -> CostModel:
    """Fit the model of this machine."""
    return fit(list(measured(FITTED, progress)), machine())


def _walled(degree: int) -> Formulation:
    cover = {"type": "block"} if degree == 1 else {"functions": "monomials", "degree": degree}
    return Formulation.model_validate({"cover": cover, "integrator": {"step": 1e-3}})
