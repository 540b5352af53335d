"""Rows of whole steps: what they say, how they grow, and the aims they are held to."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from records import Row

PHASES = ("search", "assembly", "solve", "update", "rest")
DT = 1e-3
"""Length of a step (s)."""
AIMS = {
    ("wall", 100): 5e-3,
    ("wall", 1000): 40e-3,
    ("wall", 10_000): 0.8,
    ("wall", 100_000): 12.0,
    ("pile", 1000): 0.35,
    ("pile", 10_000): 5.0,
}
"""Processor seconds a step."""
GROWTH = 1.15
"""Exponent of seconds over blocks that no wall is to exceed."""
GUESS = 1.3
"""Exponent taken where two sizes have not been measured yet."""
HANGING = 2.0
"""A step that has taken so many times the mean when the budget ends is in doubt."""


@dataclass(frozen=True, kw_only=True)
class StepRow(Row):
    """One enforcement on one scene of one size.

    Attributes
    ----------
    scene, enforcement, size
        Names in `whole_scenes.SCENES` and `kinds.KINDS`, and the number of blocks asked for.
    status
        "converged"; "cut": every step was taken, some in shorter ones; "failed": the run gave up;
        "stopped": the budget was spent; "broken": an error, or the system, ended it; "not run".
    sentence
        The same in words; "" for "converged".
    blocks, contacts
        Of the scene; contacts of the last step.
    asked, done, left_out
        Steps asked for, taken, and of these the first ones that no mean counts.
    cut
        Accepted steps that were shorter than asked for.
    unfinished
        Processor seconds spent in a step that was not done when the row was stopped.
    seconds, elapsed
        Processor and wall-clock seconds a step of `DT`; 0 when no step was taken.
    phases
        Wall-clock seconds a step by phase.
    passes
        Mean number a step.
    prepare
        Wall-clock seconds before the first step, by part.
    prepared
        Processor seconds before the first step.
    memory
        Largest memory of the process (bytes).
    """

    scene: str
    enforcement: str
    size: int
    status: str
    sentence: str = ""
    blocks: int = 0
    contacts: int = 0
    asked: int = 0
    done: int = 0
    left_out: int = 0
    cut: int = 0
    unfinished: float = 0.0
    seconds: float = 0.0
    elapsed: float = 0.0
    phases: dict[str, float] = field(default_factory=dict)
    passes: float = 0.0
    prepare: dict[str, float] = field(default_factory=dict)
    prepared: float = 0.0
    memory: int = 0

    @property
    def key(self) -> tuple[str, str, int]:
        """Scene, enforcement and size."""
        return self.scene, self.enforcement, self.size

    @property
    def sound(self) -> bool:
        """Whether every step taken converged as asked for, and the next was not in doubt.

        Of a row that was stopped the first step alone says nothing: it is not like the others.
        """
        stopped = (
            self.status == "stopped"
            and self.left_out > 0
            and self.unfinished <= HANGING * self.seconds
        )
        return self.cut == 0 and self.seconds > 0 and (self.status == "converged" or stopped)

    @property
    def ended(self) -> bool:
        """Whether a larger budget would change nothing."""
        return self.status in ("converged", "cut", "failed")

    @property
    def ratio(self) -> float:
        """Seconds a step over the aim; nan without aim or step."""
        aim = AIMS.get((self.scene, self.size), np.nan)
        return self.seconds / aim if self.seconds else float("nan")


def smaller(row: StepRow, rows: Iterable[StepRow]) -> StepRow | None:
    """Sound row of the same scene and enforcement of the next smaller size."""
    found = [one for one in rows if one.key[:2] == row.key[:2] and one.sound]
    return max((one for one in found if one.size < row.size), key=lambda r: r.size, default=None)


def growth(row: StepRow, rows: Iterable[StepRow], anyhow: bool = False) -> float:
    """Exponent of seconds over blocks since the next smaller size.

    It is nan where one of the two is not sound, and, but for ``anyhow``, where they were measured
    at different commits: what was made faster in between is no growth.
    """
    last = smaller(row, rows)
    if last is None or not row.sound or not (anyhow or last.commit == row.commit):
        return float("nan")
    return float(np.log(row.seconds / last.seconds) / np.log(row.blocks / last.blocks))


def expected(wanted: StepRow, rows: list[StepRow], steps: int) -> tuple[float, str]:
    """Processor seconds that ``steps`` steps of a size may take, and the sentence that says why.

    From the largest smaller size: of sound rows seconds a step grow with the exponent of the last
    two sizes, at least 1; of others all that they used grows as N^1.3. (0, "") where there is none.
    """
    known = [one for one in rows if one.key[:2] == wanted.key[:2] and one.size < wanted.size]
    known = [one for one in known if one.used > 0]
    if not known:
        return 0.0, ""
    last = max(known, key=lambda row: row.size)
    times = wanted.size / last.size
    if not (last.sound or last.status == "cut"):
        took = f"{last.status} at {last.size} blocks after {last.used:.3g} s"
        return last.used * times**GUESS, took
    power = growth(last, rows, anyhow=True)
    power = GUESS if np.isnan(power) else max(power, 1.0)
    seconds = last.seconds * times**power
    whole = seconds * steps + last.prepared * times
    return whole, f"about {seconds:.3g} s a step expected from growth as N^{power:.2f}"


def table(rows: list[StepRow]) -> str:
    """Rows as a table in Markdown; phases as parts of the whole."""
    head = "| enforcement | blocks | contacts a block | ms a step | aim | grows as | "
    head += " | ".join(f"{phase} %" for phase in PHASES) + " | passes | MB | steps |"
    return "\n".join([head, "|" + "---|" * (9 + len(PHASES)), *(line(r, rows) for r in rows)])


def line(row: StepRow, rows: list[StepRow]) -> str:
    """One row of the table; a figure of steps that did not all converge stands in brackets."""
    if not row.seconds:
        empty = " | ".join([""] * (len(PHASES) + 5))
        return f"| {row.enforcement} | {row.size} | {empty} | {steps_text(row)} |"
    power = growth(row, rows)
    cells = [
        row.enforcement,
        str(row.blocks),
        f"{row.contacts / row.blocks:.1f}",
        milliseconds(row.seconds) if row.sound else f"({milliseconds(row.seconds)})",
        "" if np.isnan(row.ratio) else f"{milliseconds(AIMS[row.scene, row.size])}",
        "" if np.isnan(power) else f"N^{power:.2f}",
        *(f"{100 * row.phases[phase] / row.elapsed:.0f}" for phase in PHASES),
        f"{row.passes:.0f}",
        f"{row.memory / 1e6:.0f}" if row.memory else "",
        steps_text(row),
    ]
    return "| " + " | ".join(cells) + " |"


def milliseconds(seconds: float) -> str:
    """Milliseconds in three digits, at most one behind the point."""
    value = 1e3 * seconds
    return f"{value:.1f}" if value < 100 else f"{float(f'{value:.3g}'):.0f}"


def steps_text(row: StepRow) -> str:
    """How the steps of a row came out, in a few words."""
    if row.status == "converged":
        return f"all {row.done} converged"
    if row.status == "cut":
        return f"{row.done} taken, {row.cut} of them shorter"
    if row.status == "not run":
        return "not run"
    shorter = f", {row.cut} of them shorter" if row.cut else ""
    return f"{row.status} after {row.done} of {row.asked}{shorter}"


def phase_growth(rows: list[StepRow], kinds: tuple[str, ...]) -> str:
    """Table of the exponents of every phase from size to size."""
    head = "| scene | enforcement | blocks | " + " | ".join((*PHASES, "whole")) + " |"
    lines = [head, "|" + "---|" * (4 + len(PHASES))]
    for row in rows:
        last = smaller(row, rows)
        whole = growth(row, rows)
        if row.enforcement not in kinds or last is None or np.isnan(whole):
            continue
        times = np.log(row.blocks / last.blocks)
        powers = [np.log(_spent(row, name) / _spent(last, name)) / times for name in PHASES]
        cells = " | ".join(f"{power:.2f}" for power in (*powers, whole))
        sizes = f"{last.size} to {row.size}"
        lines.append(f"| {row.scene} | {row.enforcement} | {sizes} | {cells} |")
    return "\n".join(lines)


def _spent(row: StepRow, phase: str) -> float:
    """Processor seconds of a phase: its part of the wall-clock time of all."""
    return row.seconds * max(row.phases[phase], 1e-9) / row.elapsed


def preparation(rows: list[StepRow]) -> str:
    """Table of what comes before the first step, a line for each scene and size; the quickest."""
    lines = ["| scene | blocks | s | grows as | covers (s) | effects (s) |", "|" + "---|" * 6]
    last: StepRow | None = None
    for scene in dict.fromkeys(row.scene for row in rows):
        some = [row for row in rows if row.scene == scene and row.prepared > 0]
        for size in sorted({row.size for row in some}):
            row = min((r for r in some if r.size == size), key=lambda r: r.prepared)
            power = ""
            if last is not None and last.scene == scene:
                times = np.log(row.prepared / last.prepared) / np.log(row.blocks / last.blocks)
                power = f"N^{times:.2f}"
            parts = " | ".join(f"{row.prepare[name]:.3g}" for name in ("covers", "effects"))
            lines.append(f"| {scene} | {row.blocks} | {row.prepared:.3g} | {power} | {parts} |")
            last = row
    return "\n".join(lines)


def sentences(rows: list[StepRow]) -> str:
    """What is to be said of rows that are not as asked for, one point each."""
    told = [row for row in rows if row.sentence]
    return "\n".join(f"- {r.enforcement}, {r.size} blocks: {r.sentence}" for r in told)
