"""Bars of where the time of runs goes, by phase and by effect."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import SMALL, frame

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Seconds = Mapping[str, float]

PHASES = {
    "covers": "#6a4c93",
    "effects": "#b8a1cf",
    "search": "#e08e0b",
    "contact": "#f3d98b",
    "assembly": "#93aac2",
    "solve": "#1d4e89",
    "update": "#2a7f62",
    "reports": "#7fb069",
    "audits": "#4d9de0",
    "rest": "#c9c5ba",
}
EFFECTS = {
    "supports": "#1d4e89",
    "loads": "#93aac2",
    "body loads": "#4d9de0",
    "gravity": "#2a7f62",
    "inertia": "#7fb069",
    "contact": "#e08e0b",
    "solution with contact": "#f3d98b",
    "bonded interfaces": "#c1121f",
    "artificial joints": "#7a1f3d",
    "initial velocity": "#6a4c93",
    "initial stress": "#b8a1cf",
    "other effects": "#9c8b00",
    "covers, elasticity, solution": "#e4e1d8",
}
BELOW = 30.0  # points below the axes at which the legend of bars begins
VISIBLE = 0.5  # percent; parts that are nowhere more are not drawn


def by_phase(axes: "Axes", phases: Mapping[str, Seconds]) -> None:
    """Draw seconds by phase, of runs by name, as shares; phases without a colour are the rest."""
    spent = {}
    for name, one in phases.items():
        known = {phase: seconds for phase, seconds in one.items() if phase in PHASES}
        others = sum(one.values()) - sum(known.values())
        spent[name] = {**known, "rest": known.get("rest", 0.0) + others}
    _bars(axes, spent, PHASES, "by phase")


def by_effect(axes: "Axes", phases: Mapping[str, Seconds], effects: Mapping[str, Seconds]) -> None:
    """Draw seconds by effect as shares; effects that have no colour are one, what is left another.

    Runs are those of ``phases``, by name, which say how long each took.
    """
    spent = {}
    for name, one in effects.items():
        known = {effect: seconds for effect, seconds in one.items() if effect in EFFECTS}
        total = sum(one.values())
        known["other effects"] = total - sum(known.values())
        known["covers, elasticity, solution"] = max(sum(phases[name].values()) - total, 0.0)
        spent[name] = known
    _bars(axes, spent, EFFECTS, "by effect")


def _bars(
    axes: "Axes",
    spent: Mapping[str, Seconds],
    colours: Mapping[str, str],
    words: str,
) -> None:
    """Draw how the dearest run's time is shared."""
    names = list(spent)
    total = np.array([sum(one.values()) for one in spent.values()])
    left = np.zeros(len(names))
    for part, colour in colours.items():
        share = 100 * np.array([one.get(part, 0.0) for one in spent.values()])
        share = share / np.where(total > 0, total, 1.0)
        if share.max(initial=0.0) > VISIBLE:
            axes.barh(names, share, left=left, color=colour, label=part, height=0.65)
        left = left + share
    axes.set(xlim=(0, 100))
    axes.invert_yaxis()
    axes.tick_params(axis="y", labelsize=SMALL - 2)
    frame(axes, "share of the dearest run's time  (%)", "", f"where the time goes, {words}")
    if names:
        from matplotlib.transforms import ScaledTranslation

        down = ScaledTranslation(0, -BELOW / 72, axes.figure.figure.dpi_scale_trans)
        axes.legend(
            fontsize=SMALL - 2,
            frameon=False,
            ncols=3,
            loc="upper center",
            bbox_to_anchor=(0.45, 0.0),
            bbox_transform=axes.transAxes + down,
            columnspacing=1.0,
            handlelength=1.0,
        )
