"""Crack fronts: the ends of the polylines of cracks, and their tips in a cut."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats, Ints

# A tip belongs to the end of a polyline within this multiple of the tolerance of the cut.
MOVED = 4.0
# Relative rounding of sums of lengths.
ROUNDING = 1e-6


@dataclass(frozen=True)
class CrackFronts:
    """Both ends of every crack of a scene and of every nucleus, and the end of every branch.

    An end without a tip lies on a boundary or on another crack.

    Attributes
    ----------
    name
        Name of each front, as "notch:start" and "notch:end".
    crack
        (n,) number of the crack among those of the geometry.
    last
        (n,) whether it is the last point of its polyline, else the first.
    """

    name: tuple[str, ...]
    crack: Ints
    last: Bools

    @classmethod
    def of(cls, names: Sequence[str]) -> "CrackFronts":
        """Return the fronts of cracks with these names."""
        both = [f"{name}:{end}" for name in names for end in ("start", "end")]
        n = len(names)
        return cls(tuple(both), np.repeat(np.arange(n), 2), np.tile([False, True], n))

    def with_born(self, number: int, nuclei: Sequence[int] = ()) -> "CrackFronts":
        """Return these and the fronts of all further polylines, up to ``number`` of them.

        ``nuclei`` are the numbers of polylines that nucleated: they have two fronts, branches one,
        their last point.
        """
        found, branches = self, 0
        for line in range(int(self.crack.max(initial=-1)) + 1, number):  # a handful of cracks
            if line in nuclei:
                ends = CrackFronts.of([nucleus_name(nuclei.index(line))])
            else:
                branches += 1
                ends = CrackFronts((f"branch {branches}",), np.zeros(1, np.int64), np.array([True]))
            found = CrackFronts(
                (*found.name, *ends.name),
                np.append(found.crack, ends.crack + line),
                np.append(found.last, ends.last),
            )
        return found

    def __len__(self) -> int:
        return len(self.crack)

    def points(self, cracks: Sequence[Floats]) -> Floats:
        """Places (n, 2) of the fronts on the polylines (m)."""
        pairs = zip(self.crack, self.last, strict=True)
        return np.array([cracks[crack][-1 if last else 0] for crack, last in pairs]).reshape(-1, 2)

    def tips(self, cut: CutCells, cracks: Sequence[Floats]) -> Ints:
        """Number (n,) of the tip of each front among those of a cut; -1 where there is none."""
        found = np.full(len(self), -1, dtype=np.int64)
        if not len(cut.tips):
            return found
        away = np.hypot(*np.moveaxis(self.points(cracks)[:, None] - cut.tips.point, -1, 0))
        away = np.where(cut.tips.crack == self.crack[:, None], away, np.inf)
        nearest = np.argmin(away, axis=1)
        there = away[np.arange(len(self)), nearest] <= MOVED * cut.crack_tolerance
        found[there] = nearest[there]
        return found

    def former(self, before: Sequence[Floats], after: Sequence[Floats]) -> Floats:
        """Return where the fronts were before (n, 2); those of new polylines where these began.

        Branches and nuclei at an edge begin at the first of two points, nuclei inside at the second
        of three.
        """
        begun = [line[(len(line) - 1) // 2][None] for line in after[len(before) :]]
        return self.points([*before, *begun])

    def gained(self, before: Sequence[Floats], after: Sequence[Floats]) -> Floats:
        """Length (n,) by which each front has grown from one set of polylines to another (m)."""
        return np.asarray(np.hypot(*(self.points(after) - self.former(before, after)).T))

    def swing(self, cracks: Sequence[Floats], grown: Floats) -> float:
        """Largest zigzag (rad) of grown segments: the smaller of two successive opposite turns."""
        largest = 0.0
        for crack, last, length in zip(self.crack, self.last, grown, strict=True):  # a handful
            line = cracks[crack][::-1] if last else cracks[crack]
            way = np.diff(line, axis=0)
            pieces = np.cumsum(np.hypot(*way.T)) <= length * (1 + ROUNDING)
            angle = np.arctan2(*way[pieces].T[::-1])
            turn = np.diff(angle)
            turn = np.arctan2(np.sin(turn), np.cos(turn))
            back = turn[1:] * turn[:-1] < 0
            smaller = np.minimum(np.abs(turn[1:]), np.abs(turn[:-1]))
            largest = max(largest, float(smaller[back].max(initial=0.0)))
        return largest

    def history(self, cracks: Sequence[Floats], origin: Floats, grown: Floats) -> dict[str, float]:
        """Return place in the axes of the scene (m) and growth (m) of every front, by its name."""
        row: dict[str, float] = {}
        places = self.points(cracks) + origin
        for name, (x, y), length in zip(self.name, places.tolist(), grown.tolist(), strict=True):
            row |= {f"{name}:x": x, f"{name}:y": y, f"{name}:growth": length}
        return row


def nucleus_name(number: int) -> str:
    """Name of the crack that nucleated as number ``number``, counted from 0."""
    return f"nucleus {number + 1}"


def may_grow(grown: Floats, most: float) -> Bools:
    """Which fronts (n,) have grown by less than ``most`` (m)."""
    return np.asarray(grown < most * (1 - ROUNDING))
