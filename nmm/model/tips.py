"""Which crack tips carry singular functions, and whether these fit the crack; in words."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nmm.fracture.surroundings import off_line

if TYPE_CHECKING:
    from covers.cutting.cut_cells import CutCells
    from integration.arrays import Bools, Ints
    from nmm.assembly.model import Model

# So many tips are named one by one.
NAMED = 3


@dataclass(frozen=True)
class ModelTips:
    """The tips of a model.

    Attributes
    ----------
    places
        (n,) in words.
    functions
        (n,) whether the covers about each carry its functions.
    bent
        (n,) whether these covers hold faces of cracks off the line behind the tip.
    """

    places: list[str]
    functions: "Bools"
    bent: "Bools"


def tips_of(model: "Model") -> ModelTips | None:
    """Return what the tips of a model carry; None without any."""
    cut = model.cut
    if not len(cut.tips):
        return None
    singular = model.manifold.singular
    n = len(cut.tips)
    functions, bent = np.zeros(n, dtype=bool), np.zeros(n, dtype=bool)
    for tip, point in enumerate(cut.tips.point):  # a handful of tips
        functions[tip] = (singular == point).all(axis=1).any()
        bent[tip] = functions[tip] and _bent(cut, tip)
    places = [f"[{x:.6g}, {y:.6g}]" for x, y in cut.tips.point]
    return ModelTips(places, functions, bent)


def tip_warnings(model: "Model") -> list[str]:
    """Return what the tips do to stress intensities: a sentence for each kind of tip."""
    tips = tips_of(model)
    if tips is None:
        return []
    found = []
    plain, wrong = np.flatnonzero(~tips.functions), np.flatnonzero(tips.bent)
    if len(plain):
        found.append(
            f"{len(plain)} crack tips without tip functions, {_named(tips, plain)}: cracks act as "
            "if they ended before the cell of their tip, and stress intensities come out too "
            "small, by 2 to 30 % where cells are a fortieth to a tenth of the body, by up to 70 % "
            "where the crack has a kink within a cell; use smaller cells, or [cover.enrichment] "
            "where the crack is straight"
        )
    if len(wrong):
        found.append(
            f"{len(wrong)} crack tips with functions of a straight crack in covers that hold a "
            f"kink or another crack, {_named(tips, wrong)}: stress intensities may be 40 % off "
            "where it is half a cell away, 20 % at one cell; use cells of less than half its "
            "distance"
        )
    return found


def tip_lines(model: "Model") -> Iterator[str]:
    """Yield a line for each tip: whether it carries functions, and whether they fit."""
    tips = tips_of(model)
    if tips is None:
        return
    for place, has, bent in zip(tips.places, tips.functions, tips.bent, strict=True):
        said = "carries tip functions" if has else "without tip functions"
        more = ", but the crack is not straight and alone in their covers" if bent else ""
        yield f"crack tip {place}: {said}{more}"


def _named(tips: ModelTips, which: "Ints") -> str:
    more = f" and {len(which) - NAMED} more" if len(which) > NAMED else ""
    return "at " + ", ".join(tips.places[n] for n in which[:NAMED]) + more


def _bent(cut: "CutCells", tip: int) -> bool:
    """Whether faces in the covers about a tip, which no crack parts, lie off its line."""
    from covers.approximation.enrichment import touching_covers

    point, ahead = cut.tips.point[tip], cut.tips.direction[tip]
    about = np.asarray(np.isin(cut.covers, touching_covers(cut, point)).any(axis=1))
    edges = cut.boundary
    faces = (edges.crack >= 0) & about[edges.element]
    return bool(off_line(edges.start[faces], edges.end[faces], point, ahead).any())
