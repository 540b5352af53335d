"""The nets of a formulation: one over all blocks, and those that blocks have of their own."""

from collections.abc import Sequence
from dataclasses import dataclass
from inspect import signature
from typing import TYPE_CHECKING, Any

import numpy as np

from covers.cutting.again.recut import cut_again
from covers.cutting.cut import Cutting, cut, cutting
from covers.cutting.cut_cells import CutCells
from covers.cutting.several_meshes import joined_cover, joined_cut
from covers.mathematical.base import Cover as MathematicalCover
from integration.arrays import Floats, Ints
from nmm.errors import Fault, FormulationError
from nmm.geometry.tessellation.cover_types import COVER_TYPES
from nmm.registry import check_values

if TYPE_CHECKING:
    from nmm.formulation import CoverNet, CoverTable
    from nmm.geometry.blocks import Regions


@dataclass(frozen=True)
class LaidAndCut:
    """Nets as one cover, what cutting made of them, and what the next cut may go on from."""

    cover: MathematicalCover
    cells: CutCells
    cutting: Cutting | None = None


def laid_and_cut(
    regions: "Regions",
    cover: "CoverTable",
    lines: Sequence[Floats],
    before: Cutting | None = None,
) -> LaidAndCut:
    """Lay the nets of ``[cover]`` over the blocks and cut them by blocks and lines.

    One net that was cut ``before`` by the same blocks is not laid again, and cut where lines have
    grown.

    Raises
    ------
    ValueError
        A net that cannot be laid or cut, or that names no block.
    """
    if not cover.nets:
        return _one_net(regions, cover, lines, before)
    members = _members(regions, cover.nets)
    parts = [(net, own) for net, own in zip([None, *cover.nets], members, strict=True) if len(own)]
    nets, cuts = [], []
    for net, own in parts:  # a handful of nets
        blocks = regions.polygons.take(own)
        around = regions.box if net is None else blocks.points
        laid = _laid(cover, net, around)
        if laid.settles:
            raise ValueError(
                f'nets: type "{cover.type}": triangles or quads expected where blocks have nets of '
                "their own: use one of these, or remove [[cover.nets]]"
            )
        nets.append(laid)
        cuts.append(cut(laid, blocks, lines, rounding=regions.rounding))
    whole = joined_cut(nets, cuts, [own for _, own in parts])
    return LaidAndCut(joined_cover(nets), whole)


def _one_net(
    regions: "Regions", cover: "CoverTable", lines: Sequence[Floats], before: Cutting | None
) -> LaidAndCut:
    if before is not None and before.regions is regions.polygons:
        found = cut_again(before, lines)
        return LaidAndCut(found.cover, found.cells, found)
    whole = _laid(cover, None, regions.box)
    found = cutting(whole, regions.polygons, lines, rounding=regions.rounding)
    if not whole.settles:
        return LaidAndCut(whole, found.cells, found)

    def again(other: MathematicalCover) -> CutCells:
        return cut(other, regions.polygons, lines, rounding=regions.rounding)

    return LaidAndCut(*whole.settled(found.cells, again))


def _members(regions: "Regions", nets: "Sequence[CoverNet]") -> list[Ints]:
    """Blocks of the common net, and of each of the others; the last net that names a block has it.

    Raises
    ------
    ValueError
        A name that no block has.
    """
    which = np.zeros(len(regions), dtype=np.int64)
    for number, net in enumerate(nets, 1):  # a handful of nets
        chosen = regions.select(net.block)
        if not len(chosen):
            raise ValueError(
                f'nets: block "{net.block}": no block of this name: expected one of '
                f"{', '.join(regions.name[:8])}: correct the name"
            )
        which[chosen] = number
    return [np.flatnonzero(which == number) for number in range(len(nets) + 1)]


def net_class(cover: "CoverTable") -> Any:
    """Return the class of a formulation's cover.

    Raises
    ------
    FormulationError
        When it is not known, may not be imported, lays no net, or has no such options.
    """
    kind: Any = COVER_TYPES.load(cover.type)
    regular = getattr(kind, "regular", None)
    if regular is None:
        expected, remedy = "a class method regular(bounds, size, ...)", "define it"
        raise FormulationError(Fault("cover", f'"{cover.type}"', expected, remedy))
    parameters = list(signature(regular).parameters.values())
    if all(one.kind is not one.VAR_KEYWORD for one in parameters):
        given = ("bounds", "size", "angle", "shift")
        known = {one.name: one.annotation for one in parameters if one.name not in given}
        check_values("[cover.options]", known, cover.options)
    return kind


def _laid(cover: "CoverTable", net: "CoverNet | None", points: Floats) -> MathematicalCover:
    bounds = np.stack([points.min(axis=0), points.max(axis=0)])
    chosen: dict[str, Any] = {name: getattr(cover, name) for name in ("size", "angle", "shift")}
    if net is not None:
        own = {name: getattr(net, name) for name in chosen}
        chosen |= {name: value for name, value in own.items() if value is not None}
    kind = net_class(cover)
    laid: MathematicalCover = kind.regular(bounds, **chosen, **cover.options)
    return laid
