"""What the manifold costs beside finite elements: runs, records, and the tables of the manual.

``OPENBLAS_NUM_THREADS=1 python benchmarks/manifold_cost.py`` solves everything, writes the records
to ``docs/manifold_cost/`` and the tables into ``docs/manifold_cost.md``. With ``tables`` as
argument it only writes the tables from the records; with ``smooth``, ``singular`` or ``cutting`` it
repeats one part. Takes about a quarter of an hour and 4 GiB.
"""

from __future__ import annotations

import csv
import platform
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import cutting
import numpy as np
import scipy
import skfem
from cost_tables import tables
from singular_costs import cases as singular_cases
from smooth_costs import PHASES, Cost, blocks, elements, on_cut, on_fitted

DOCS = Path(__file__).parents[1] / "docs"
RECORDS = DOCS / "manifold_cost"
COLUMNS = ("problem", "method", "n", "position", "unknowns", "error", *PHASES)

FITTED = {0: (32, 64, 128, 256, 384), 1: (16, 32, 64, 128, 192), 2: (8, 16, 32, 64, 128)}
CUT = {0: (32, 64, 128, 256), 1: (16, 32, 64, 128, 160), 2: (8, 16, 32, 64, 96)}
ELEMENTS = {1: (16, 32, 64, 128, 256, 384), 2: (8, 16, 32, 64, 128, 192), 3: (8, 16, 32, 64, 128)}
# Unknowns up to which all positions are tried and runs are repeated; then a few, each once.
SWEPT, REPEATED = 45_000, 20_000
POSITIONS, FEW, REPEATS = 20, 3, 2

Case = Callable[[], Cost]


def smooth_cases() -> Iterator[Case]:
    """All solutions of the smooth problem, sizes interleaved."""
    for rung in range(6):
        for degree in (0, 1, 2):
            if rung < len(ELEMENTS[degree + 1]):
                yield partial(elements, degree + 1, ELEMENTS[degree + 1][rung])
            if rung < len(FITTED[degree]):
                yield partial(on_fitted, degree, FITTED[degree][rung])
            if rung < len(CUT[degree]):
                n = CUT[degree][rung]
                unknowns = 2.4 * n * n * (degree + 1) * (degree + 2) / 2
                for position in range(1, (POSITIONS if unknowns < SWEPT else FEW) + 1):
                    yield partial(on_cut, degree, n, position)


def least(case: Case) -> Cost:
    """Least seconds of each phase; singular problems and the manifold's long runs are run once."""
    found = case()
    short = found.unknowns < REPEATED or found.method.startswith("P")
    for _ in range(REPEATS - 1 if short and found.problem == "smooth" else 0):
        again = case()
        for phase, value in again.seconds.items():
            found.seconds[phase] = min(found.seconds[phase], value)
    return found


def record(cases: Iterator[Case], file: Path) -> None:
    """Run the cases and write a line for each."""
    with file.open("w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for case in cases:
            cost = least(case)
            seconds = [f"{cost.seconds[phase]:.4f}" for phase in PHASES]
            first = [cost.problem, cost.method, cost.n, cost.position, cost.unknowns]
            writer.writerow([*first, f"{cost.error:.4e}", *seconds])
            stream.flush()


def versions() -> str:
    """What it ran on."""
    return (
        f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}, "
        f"scipy {scipy.__version__}, scikit-fem {skfem.__version__}, one thread"
    )


def main(parts: tuple[str, ...] = ("smooth", "singular", "cutting")) -> None:
    """Run the parts and write the tables."""
    RECORDS.mkdir(exist_ok=True)
    if parts != ("tables",):
        on_cut(1, 16, 1), elements(2, 8)  # loads what is loaded once
    if "smooth" in parts:
        record(smooth_cases(), RECORDS / "smooth.csv")
        (RECORDS / "versions.txt").write_text(versions() + "\n")
    if "singular" in parts:
        record(singular_cases(), RECORDS / "singular.csv")
    if "cutting" in parts:
        many = cutting.voronoi(10_000)
        record(iter([partial(blocks, many)]), RECORDS / "blocks.csv")
        (RECORDS / "cutting.md").write_text("\n".join(cutting.main(3)) + "\n")
    page = DOCS / "manifold_cost.md"
    page.write_text(tables(page.read_text(), RECORDS))


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or ("smooth", "singular", "cutting"))
