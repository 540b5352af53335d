"""The verb of motions: response spectra of monitors. What it needs it imports."""

from pathlib import Path
from typing import Annotated

import typer

from nmm.cli.terminal import faults_told, tell_files


def spectrum(
    run: Annotated[Path, typer.Argument(help="Folder of a run.", metavar="RUN")],
    monitor: Annotated[str, typer.Argument(help="Name of a monitor.", metavar="MONITOR")],
    axis: Annotated[str, typer.Option(help="Along x or y.")] = "x",
    damping: Annotated[
        float, typer.Option(min=0, max=0.99, help="Ratio of critical damping.")
    ] = 0.05,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Folder to write to; else that of the run.")
    ] = None,
) -> None:
    """Write the response spectrum of a monitor as numbers and as a picture."""
    with faults_told():
        import numpy as np

        import nmm
        from nmm.plots.results.graphs.spectrum import spectrum as draw
        from nmm.results.monitor_spectrum import monitor_spectrum

        found = monitor_spectrum(nmm.read_run(run), monitor, axis, ratio=damping)
        folder = out or run
        folder.mkdir(parents=True, exist_ok=True)
        name = f"spectrum_{monitor}_{axis}".replace(" ", "_")
        numbers, picture = folder / f"{name}.csv", folder / f"{name}.png"
        columns = {
            "period_s": found.period,
            "displacement_m": found.displacement,
            "pseudo_velocity_m_s": found.pseudo_velocity,
            "pseudo_acceleration_m_s2": found.pseudo_acceleration,
            "absolute_acceleration_m_s2": found.absolute_acceleration,
        }
        table = np.column_stack(list(columns.values()))
        np.savetxt(numbers, table, delimiter=",", header=",".join(columns), comments="")
        draw(found, f"{monitor}, along {axis}", path=picture)
        tell_files([numbers, picture])


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(spectrum)
