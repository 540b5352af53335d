"""The figure of a comparison: fields, cracks and forces side by side, and a curve of each run."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from integration.arrays import Floats
from nmm.results.frame import Frame
from nmm.stepping.drive.verdict import status_code
from nmm.stepping.run import Run
from nmm.study.comparison.runs import Comparison


def draw(study: Comparison, path: Path) -> None:
    """Draw the page's figure."""
    from nmm.plots.results.compared import DrawnRun
    from nmm.plots.results.comparison import comparison
    from nmm.results.viewing.grids import contact_vectors

    made, image = study.made, study.raster.image
    x, y = curve_columns([run for _, run, _ in made])
    none = np.zeros(0)  # of a run that ended before its first step
    shown = [
        DrawnRun(
            one.name,
            one.family,
            one.method,
            image(np.hypot(*values.displacement.T)),
            image(values.mises),
            last_frame(done).contact_position,
            contact_vectors(last_frame(done)),
            cracks(done),
            done.history.get(x, none),
            done.history.get(y, none),
        )
        for one, done, values in made
    ]
    differences = [
        (one.displacement - shown[0].displacement, one.stress - shown[0].stress)
        for one in shown[1:]
    ]
    title = heading(study)
    comparison(shown, differences, study.raster.extent, title=title, curve=(x, y), path=path)


def heading(study: Comparison) -> str:
    """Return the title, with the runs whose pictures are no answer and those without a picture."""
    ends = [(x.name, "not run" if x.run is None else x.run.summary.status) for x in study.runs]
    bad = [f"{name}: {end}" for name, end in ends if status_code(end)]
    return "\n".join(line for line in (study.title, ", ".join(bad)) if line)


def cracks(run: Run) -> list[Floats]:
    """Return lines (n, 2) in reference coordinates (m): joints that broke, ways of crack tips."""
    from nmm.plots.results.broken import broken_parts
    from nmm.plots.results.crack_paths import grown_paths

    frame = last_frame(run)
    topology = run.topologies[frame.topology]
    parts = broken_parts(run.frames, topology, frame).on(topology.elements)
    return [*parts, *grown_paths(run).values()]


def last_frame(run: Run) -> Frame:
    """Return the last frame of a run in equilibrium; what moves after failure is not compared."""
    return next((one for one in reversed(run.frames) if one.stage != "failure"), run.frames[-1])


def curve_columns(runs: Sequence[Run]) -> tuple[str, str]:
    """Return what grows in the first run with a step, and the monitor that moved most in it.

    Where scenes of one case have no monitor in common it is the elastic energy.
    """
    histories = [run.history for run in runs if len(run.history["step"])]
    if not histories:
        return "time", "strain_energy"
    known = histories[0]
    clock = "load_factor" if np.ptp(known["load_factor"]) > 0 else "time"
    common = set(known).intersection(*histories)
    moved = [name for name in known if name in common and name.startswith("monitor:")]
    most = max(moved, key=lambda name: float(np.nanmax(np.abs(known[name]))), default="")
    return clock, most or "strain_energy"
