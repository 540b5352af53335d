"""Pictures of runs; the only package that imports matplotlib, and only when something is drawn.

Each function takes a run in memory or a stored one, draws into `ax` or a figure of its own, saves
it when `path` is given and returns the axes.
"""

from nmm.plots.gallery import draw_all
from nmm.plots.results.blocks import blocks
from nmm.plots.results.contact_forces import contact_forces
from nmm.plots.results.covers import covers
from nmm.plots.results.crack_paths import crack_paths
from nmm.plots.results.deformed import deformed, failure_mode
from nmm.plots.results.graphs.curves import curve, load_displacement
from nmm.plots.results.graphs.history import history, overview
from nmm.plots.results.members import members
from nmm.plots.results.stress import stress

__all__ = [
    "blocks",
    "contact_forces",
    "covers",
    "crack_paths",
    "curve",
    "deformed",
    "draw_all",
    "failure_mode",
    "history",
    "load_displacement",
    "members",
    "overview",
    "stress",
]
