"""Which crack tips carry singular functions, in words."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
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
    cohesive
        (n,) whether its faces begin bonded: stress is bounded there, and no function is missed.
    """

    places: list[str]
    functions: "Bools"
    cohesive: "Bools"


def tips_of(model: "Model") -> ModelTips | None:
    """Return what the tips of a model carry; None without any."""
    cut = model.cut
    if not len(cut.tips):
        return None
    singular = model.manifold.singular
    n = len(cut.tips)
    functions = np.zeros(n, dtype=bool)
    for tip, point in enumerate(cut.tips.point):  # a handful of tips
        functions[tip] = (singular == point).all(axis=1).any()
    places = [f"[{x:.6g}, {y:.6g}]" for x, y in cut.tips.point]
    return ModelTips(places, functions, np.isin(cut.tips.crack, model.bonded))


def tip_warnings(model: "Model") -> list[str]:
    """Return what tips without functions do to stress intensities, in a sentence."""
    tips = tips_of(model)
    plain = np.flatnonzero([] if tips is None else ~(tips.functions | tips.cohesive))
    if tips is None or not len(plain):
        return []
    return [
        f"{len(plain)} crack tips without tip functions, {_named(tips, plain)}: cracks act as "
        "if they ended before the cell of their tip, and stress intensities come out too "
        "small, by 2 to 30 % where cells are a fortieth to a tenth of the body, by up to 70 % "
        "where the crack has a kink within a cell; use a mesh of monomials with [cover.enrichment] "
        "tips = true, and cells of less than a third of the length of the crack"
    ]


def tip_lines(model: "Model") -> Iterator[str]:
    """Yield a line for each tip: whether it carries functions, and whether it is to."""
    tips = tips_of(model)
    if tips is None:
        return
    for place, has, whole in zip(tips.places, tips.functions, tips.cohesive, strict=True):
        said = "carries tip functions" if has else "without tip functions"
        yield f"crack tip {place}: {'cohesive, without a singularity' if whole else said}"


def _named(tips: ModelTips, which: "Ints") -> str:
    more = f" and {len(which) - NAMED} more" if len(which) > NAMED else ""
    return "at " + ", ".join(tips.places[n] for n in which[:NAMED]) + more
