"""The cases of the seed paper by several ways of breaking.

``python examples/seed_cases/cases.py KEY`` runs those whose key begins so, or all, prints their
lines of the tables of ``docs/seed_cases.md`` and draws its pictures.
"""

import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import process_time

import numpy as np

import nmm
from nmm import plots

# Seconds on the wall clock that a case may take.
BUDGET = 300.0
HERE = Path(__file__).parent
DOCS = HERE.parents[1] / "docs"
BEAM = (HERE.parent / "kitoh_beam" / "kitoh_130.toml").read_text()
PULL_OUT = (HERE / "pull_out" / "bonds.toml").read_text()

EVENTS = '\n[loading.control]\ntype = "events"\nfall = 0.1\n\n[[reference]]'
# Rigid blocks on springs as stiff as the material between their middles (Kawai 1978).
RIGID = (
    '\n[formulation.cover]\nfunctions = "rigid"\n\n[formulation.contact]\nbonds = "spring"\n'
    'bond_stiffness = 1\njoint_points = "gauss"\n'
)


@dataclass(frozen=True)
class Row:
    """One run: what it is called, and what came of it."""

    way: str
    load: float
    status: str
    where: str
    energy: float
    pieces: str
    seconds: float


def beam(height: float = 100.0, blocks: int = 130, energy: float | None = None) -> str:
    """Return the plain beam (mm), scaled from 100 mm, event by event or softening (J/m2)."""
    text = BEAM.replace("130", str(blocks))
    scale = height / 100.0
    text = re.sub(r'"(\d+) mm"', lambda found: f'"{scale * float(found[1]):g} mm"', text)
    text = text.replace(f'thickness = "{height:g} mm"', 'thickness = "100 mm"')
    # The plates grow with the beam, and the traction on them falls.
    text = text.replace("-0.5 MPa", f"{-0.5 / scale:g} MPa")
    if energy is None:
        return text.replace("maximum_factor = 40", "").replace("\n[[reference]]", EVENTS)
    law = f'bonded = true\nlaw = "linear_softening"\nfracture_energy = "{energy:g} J/m^2"\n'
    text = text.replace("maximum_factor = 40", "maximum_factor = 1000")
    text = text.replace("increment = 1\n", f"increment = {2 * scale**0.75:g}\n")
    return text.replace("bonded = true\n", law)


def plain(way: str) -> str:
    """Return the plain beam, 130 blocks, by one of the ways in ``plain_beam``."""
    return _of("plain_beam", way)


def _of(case: str, way: str) -> str:
    return (HERE / case / f"{way}.toml").read_text()


def loose() -> str:
    """Return the pull-out whose sides are free."""
    text = re.sub(r'\[\[supports\]\]\nname = "\w+ side"\n(.+\n)+\n', "", PULL_OUT)
    return text.replace('fix = ["y"]', 'fix = ["x", "y"]', 1).replace("infinity", "0", 1)


def parted(text: str, size: str, mesh: str = "voronoi") -> str:
    """Return a scene whose tessellations are bodies of sub-blocks that part (Ke 1996)."""
    table = re.compile(r"\[\[tessellations\]\]\n((?:.+\n)+)")

    def body(found: re.Match[str]) -> str:
        keys = re.sub(r"(blocks|seed) = \d+\n", "", found[1])
        return "[[blocks]]\n" + keys.replace("region =", "vertices =")

    options = f'options = {{ mesh = "{mesh}", bond = "interface" }}\n'
    cover = f'\n[formulation.cover]\ntype = "sub_blocks"\nsize = "{size}"\n{options}'
    return table.sub(body, text) + cover


def triangles(size: str) -> str:
    """Return the plain beam whose sub-blocks are triangles."""
    return plain("sub_blocks").replace("17.5 mm", size).replace('"voronoi"', '"triangles"')


def opened(height: float, increment: float) -> str:
    """Return the softening beam led by the opening of its middle third (um): nothing is jumped."""
    places = [("right lip", 2.5 * height), ("left lip", 1.5 * height)]
    lips = "".join(
        f'\n[[monitors]]\nname = "{name}"\npoint = ["{x:g} mm", 0]\n' for name, x in places
    )
    control = (
        '[loading.control]\ntype = "opening"\nmonitors = ["right lip", "left lip"]\n'
        f'increment = "{increment:g} um"\nfall = 0.97\n'
    )
    text = beam(height, energy=100.0).replace("maximum_factor = 1000\n", "")
    return text.replace("\n[[reference]]", f"\n{control}{lips}\n[[reference]]")


CASES: dict[str, tuple[str, Callable[[], str]]] = {
    "beam bonds": ("bonds between blocks", lambda: plain("bonds")),
    "beam springs": ("rigid blocks and springs", lambda: plain("springs")),
    "beam splitting": ("joints that break, blocks that split", lambda: plain("splitting")),
    "beam crack": ("crack that grows from a notch of 10 mm", lambda: plain("notch")),
    "beam cohesive": ("cohesive crack from a notch of 10 mm", lambda: plain("cohesive")),
    "beam sub-blocks": ("130 sub-blocks that part", lambda: plain("sub_blocks")),
    "beam triangles 20": ("sub-blocks, triangles of 20 mm", lambda: triangles("20 mm")),
    "beam triangles 10": ("sub-blocks, triangles of 10 mm", lambda: triangles("10 mm")),
    "pull-out bonds": ("bonds between blocks, k = infinity", lambda: PULL_OUT),
    "pull-out free bonds": ("bonds between blocks, k = 0", loose),
    "pull-out rigid": (
        "rigid blocks and springs, k = infinity",
        lambda: _of("pull_out", "springs"),
    ),
    "pull-out free rigid": ("rigid blocks and springs, k = 0", lambda: loose() + RIGID),
    "pull-out sub-blocks": (
        "704 sub-blocks that part, k = infinity",
        lambda: _of("pull_out", "sub_blocks"),
    ),
    "pull-out free sub-blocks": (
        "704 sub-blocks that part, k = 0",
        lambda: parted(loose(), "15.957 mm"),
    ),
    "pull-out cohesive": (
        "cohesive cone, k = infinity",
        lambda: _of("pull_out", "cohesive"),
    ),
    "pull-out crack": (
        "cracks that grow, k = infinity",
        lambda: _of("pull_out", "crack"),
    ),
    "pull-out splitting": (
        "joints that break, blocks that split, k = infinity",
        lambda: _of("pull_out", "splitting"),
    ),
    "reinforced bonds": ("bonds between blocks", lambda: _of("reinforced", "bonds")),
    "reinforced rigid": ("rigid blocks and springs", lambda: _of("reinforced", "springs")),
    "reinforced sub-blocks": (
        "457 sub-blocks that part",
        lambda: _of("reinforced", "sub_blocks"),
    ),
    "reinforced splitting": (
        "joints that break, blocks that split",
        lambda: _of("reinforced", "splitting"),
    ),
    "reinforced crack": (
        "crack that grows across an embedded bar",
        lambda: _of("reinforced", "crack"),
    ),
    "reinforced cohesive": (
        "cohesive plane, embedded bar",
        lambda: _of("reinforced", "cohesive"),
    ),
}
for _n in (60, 130, 455):
    CASES[f"blocks {_n}"] = f"{_n} blocks", partial(beam, blocks=_n)
for _h in (50, 200, 800):
    CASES[f"size brittle {_h}"] = f"h = {_h} mm, brittle", partial(beam, _h)
for _h in (50, 100, 200, 400, 800):
    CASES[f"size soft {_h}"] = f"h = {_h} mm, 100 J/m2", partial(beam, _h, energy=100.0)
CASES["size opened 800"] = "h = 800 mm, 100 J/m2, led by its opening", partial(opened, 800, 0.25)
PICTURES = ("beam bonds", "pull-out bonds", "pull-out free bonds")


def ran(key: str) -> Row:
    """Run one case; draw it where the page shows it."""
    way, text = CASES[key]
    started = process_time()
    run = nmm.run(nmm.parse_scene(text()), budget=BUDGET)
    seconds = process_time() - started
    if key in PICTURES:
        plots.deformed(run, path=DOCS / "seed_cases" / f"{key.replace(' ', '_')}.png")
    largest = float(np.max(run.history["load_factor"]))
    factor = run.summary.failure_factor or largest
    lost = run.history.get("friction_loss", np.zeros(1))[-1]
    energy = run.history.get("fracture:energy", np.array([lost]))[-1]
    bodies = run.history.get("splitting:bodies")
    broken = run.stepper.broken_bonds
    pieces = f"{bodies[-1]:.0f} bodies" if bodies is not None else f"{broken} broken"
    summary = run.summary
    return Row(way, factor, summary.status, _where(run), float(energy), pieces, seconds)


def _where(run: nmm.Run) -> str:
    """Return the box (mm) about what is open at the end."""
    frame = run.frames[-1]
    x, y = (run.history.get(f"fracture:notch:end:{axis}") for axis in "xy")
    if x is not None and y is not None:
        return f"to ({1e3 * np.nanmax(x):.0f}, {1e3 * np.nanmax(y):.0f})"
    gap = frame.contact_gap
    wide = (frame.contact_force == 0).all(axis=1) & (gap > 0.2 * gap.max(initial=0.0))
    if not wide.any():
        return "-"
    place = 1e3 * frame.contact_position[wide]
    (left, low), (right, high) = place.min(axis=0), place.max(axis=0)
    return f"x {left:.0f} .. {right:.0f}, y {low:.0f} .. {high:.0f}"


def rows(beginning: str) -> Iterator[tuple[str, Row]]:
    """Run the cases whose keys begin so."""
    for key in CASES:
        if key.startswith(beginning):
            yield key, ran(key)


def line(row: Row) -> str:
    """Return a line of a table."""
    return (
        f"| {row.way} | {row.load:.4g} | {row.status} | {row.where} | {1e3 * row.energy:.3g} | "
        f"{row.pieces} | {row.seconds:.0f} |"
    )


if __name__ == "__main__":
    for _, found in rows(sys.argv[1] if len(sys.argv) > 1 else ""):
        print(line(found), flush=True)
