"""Fronts: the ends of cracks, those of a scene and those that began, wherever their tips are."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats, Ints

# A tip is the end of a polyline that lies within so many of the lengths by which a cut may move it.
MOVED = 4.0
# Part of a length by which sums of pieces are rounded.
ROUNDING = 1e-6


@dataclass(frozen=True)
class CrackFronts:
    """Both ends of every crack of a scene and of every nucleus, and the ends of branches.

    Those that are no tips now have ended or never were.

    Attributes
    ----------
    name
        Of each front, "notch:start" and "notch:end".
    crack
        (n,) number of the crack among those of the geometry.
    last
        (n,) whether it is the last point of the polyline, else the first.
    """

    name: tuple[str, ...]
    crack: Ints
    last: Bools

    @classmethod
    def of(cls, names: Sequence[str]) -> "CrackFronts":
        """Return the fronts of cracks."""
        both = [f"{name}:{end}" for name in names for end in ("start", "end")]
        n = len(names)
        return cls(tuple(both), np.repeat(np.arange(n), 2), np.tile([False, True], n))

    def with_born(self, number: int, nuclei: Sequence[int] = ()) -> "CrackFronts":
        """Return these and those of the polylines beyond theirs, of ``number`` in all.

        A nucleus has two ends, a branch one: the last.
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
        """Ends (n, 2) of the polylines."""
        pairs = zip(self.crack, self.last, strict=True)
        return np.array([cracks[crack][-1 if last else 0] for crack, last in pairs]).reshape(-1, 2)

    def tips(self, cut: CutCells, cracks: Sequence[Floats]) -> Ints:
        """Number (n,) of the tip of each front among those of a cut; -1 where it has none."""
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
        """Points (n, 2) of the polylines ``before``; where those that are new began.

        Branches and nuclei at an edge began at the first of two points, nuclei inside at the second
        of three.
        """
        begun = [line[(len(line) - 1) // 2][None] for line in after[len(before) :]]
        return self.points([*before, *begun])

    def gained(self, before: Sequence[Floats], after: Sequence[Floats]) -> Floats:
        """Length (n,) by which each front has gone on from one set of polylines to another (m)."""
        return np.asarray(np.hypot(*(self.points(after) - self.former(before, after)).T))

    def swing(self, cracks: Sequence[Floats], grown: Floats) -> float:
        """Largest of the smaller of two turns (rad) in a row, one way and back, of new pieces."""
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
        """Place in the scene's axes and growth (n,) of every front (m), by its name."""
        row: dict[str, float] = {}
        places = self.points(cracks) + origin
        for name, (x, y), length in zip(self.name, places.tolist(), grown.tolist(), strict=True):
            row |= {f"{name}:x": x, f"{name}:y": y, f"{name}:growth": length}
        return row


def nucleus_name(number: int) -> str:
    """Name of the crack that began after so many others."""
    return f"nucleus {number + 1}"


def may_grow(grown: Floats, most: float) -> Bools:
    """Which fronts (n,) have not grown as far as they may (m)."""
    return np.asarray(grown < most * (1 - ROUNDING))
