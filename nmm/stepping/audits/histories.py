"""Histories that no step sees, where a field that is stored has a clock beside the load factor."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings
from nmm.stepping.drive.verdict import CONVERGED

# Tables that each field holds to its own clock, and those that follow the load factor.
IN_SECONDS = {
    "heat": ("temperatures", "heat_fluxes", "heat_sources", "convections"),
    "seepage": ("heads", "inflows"),
    "joint_flow": ("joint_heads",),
}
IN_LOAD_FACTORS = ("loads", "supports", "water_pressures")


def histories(run: EndedRun) -> Findings:
    """Audit times of histories in statics beside a transient field, which has seconds of its own.

    Seconds given to a load are load factors that never come; load factors given to heat or water
    are seconds that have passed within the first step.
    """
    scene = run.scene
    fields = {key: getattr(scene, key) for key in IN_SECONDS}
    stored = {key: one for key, one in fields.items() if one is not None and one.transient}
    if run.dynamic or scene.stages or not stored or run.verdict.code != CONVERGED:
        return
    diffusion = run.formulation.diffusion
    for key, field in stored.items():
        step = run.formulation.loading.increment * (field.duration or 1.0)
        step = min(step, (diffusion and diffusion.step) or step)
        for name, last in _changes(scene, IN_SECONDS[key]):
            where = f"{name}: its history, in s as [{key}] duration, ends at {last:g} s, within the"
            yield AuditFinding(
                "history_missed",
                step / last,
                f"{where} first step of {step:g} s",
                f"give its times in s, up to {field.duration or 1.0:g} s, or take shorter steps",
            )
    end = run.state.time
    for name, last in _changes(scene, IN_LOAD_FACTORS):
        yield AuditFinding(
            "history_missed",
            last / end,
            f"{name}: its history, in load factors, ends at {last:g}, the run at {end:g}",
            "give its times as shares of the duration of what is stored, from 0 to 1",
        )


def _changes(scene: Any, keys: tuple[str, ...]) -> Iterator[tuple[str, float]]:
    """Yield the names of tables and the times at which their factor changes last."""
    for key in keys:
        for item in getattr(scene, key):
            pairs = pairwise(item.history or ())
            last = max((end[0] for begin, end in pairs if begin[1] != end[1]), default=0.0)
            if last > 0:
                yield item.name, last
