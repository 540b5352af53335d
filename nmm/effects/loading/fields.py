"""Vector fields over place and time: from expressions, or from a table of values."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.effects.base import Setup
from nmm.effects.loading.evaluation import evaluated
from nmm.errors import Fault, SceneError
from nmm.scene.tables.loading.expressions import Expression

if TYPE_CHECKING:
    from scipy.spatial import Delaunay

    from nmm.scene.tables.loading.fields import FieldTable

# Distance from a line below which places of a table count as on it, and distance outside of them
# within which values are extrapolated; both over the size of the table.
ON_LINE, OUTSIDE = 1e-9, 1e-6

Interpolation = Callable[[Floats], Floats]


@dataclass(frozen=True)
class ValueField:
    """A vector field over place and time.

    Attributes
    ----------
    varies
        Whether it depends on time.
    of
        Function of points (m, 2) in the axes of the scene and a time, returning values (m, 2).
    origin
        (2,) where the axes of the model lie in those of the scene (m).
    what
        The table of the scene that it belongs to, for errors.
    table
        Its values at places, if it is given so.
    """

    varies: bool
    of: Callable[[Floats, float], Floats]
    origin: Floats
    what: str
    table: "ValueTable | None" = None

    @classmethod
    def named(cls, setup: Setup, given: "tuple[str, str] | str", what: str) -> Self:
        """Return the field that a load or support gives by expressions or by a table's name."""
        if isinstance(given, str):
            table = ValueTable.of(setup.scene.fields[given])
            return cls(len(table.times) > 1, table.values, setup.origin, what, table)
        parts = [Expression.of(text) for text in given]

        def values(points: Floats, time: float) -> Floats:
            return np.stack([evaluated(one, points, time) for one in parts], axis=1)

        return cls(any(one.varies for one in parts), values, setup.origin, what)

    def checked(self, points: Floats, setup: Setup) -> None:
        """Refuse values that are not finite at the start or the end of the stage.

        Raises
        ------
        SceneError
            As `values`, which would raise it in the middle of a run.
        """
        begin = setup.start.time
        for time in (begin, begin + (setup.scene.duration or 0.0)):
            self.values(points, time)

    def sampled(self, instants: Floats) -> Callable[[Floats], Floats]:
        """Return a function for values (m, 2 n) at n instants, 0 where they are not finite."""

        def values(points: Floats) -> Floats:
            found = [self.of(points + self.origin, float(time)) for time in instants]
            one = np.concatenate(found, axis=1)
            return np.where(np.isfinite(one), one, 0.0)

        return values

    def knots(self, segments: Floats) -> Floats:
        """Return where segments (k, 2, 2) pass places of a table (k, n), from 0 to 1 along each."""
        if self.table is None:
            return np.zeros((len(segments), 0))
        return self.table.knots(segments + self.origin)

    def values(self, points: Floats, time: float) -> Floats:
        """Return the values (m, 2) at points (m, 2) in the axes of the model.

        Raises
        ------
        SceneError
            A value is not finite; with its place.
        """
        places = points + self.origin
        found = self.of(places, time)
        wrong = np.flatnonzero(~np.isfinite(found).all(axis=1))
        if len(wrong):
            x, y = places[wrong[0]]
            raise SceneError(
                Fault(
                    self.what,
                    f"field is {found[wrong[0]].tolist()} at ({x:.6g}, {y:.6g}), t = {time:.6g}",
                    "finite values wherever it acts",
                    "correct the expressions, or give a table that covers the place",
                )
            )
        return found


@dataclass(frozen=True)
class ValueTable:
    """Values at fixed places and times, linear between them.

    Attributes
    ----------
    times
        (k,) times, increasing (s).
    places
        (n, 2) places (m).
    known
        (k, n, 2) values.
    """

    times: Floats
    places: Floats
    known: Floats

    @classmethod
    def of(cls, table: "FieldTable") -> Self:
        """Return the values of a table of the scene.

        Raises
        ------
        SceneError
            Places differ between times, or one is given twice.
        """
        rows = np.array(table.rows)
        if rows.shape[1] == 4:
            rows = np.column_stack([np.zeros(len(rows)), rows])
        rows = rows[np.lexsort((rows[:, 2], rows[:, 1], rows[:, 0]))]
        times, counts = np.unique(rows[:, 0], return_counts=True)
        number = counts[0]
        parts = rows[:, 1:].reshape(len(times), -1, 4) if (counts == number).all() else None
        if parts is None or (parts[:, :, :2] != parts[:1, :, :2]).any():
            remedy = "give every place at every time"
            raise SceneError(Fault("fields", "other places at other times", "the same", remedy))
        if len(np.unique(parts[0, :, :2], axis=0)) < number:
            raise SceneError(Fault("fields", "a place twice", "each place once", "remove one row"))
        return cls(times, parts[0, :, :2], table.scale * parts[:, :, 2:])

    def values(self, points: Floats, time: float) -> Floats:
        """Return the values (m, 2) at points (m, 2) and a time (s); nan outside of the places."""
        after = int(np.clip(np.searchsorted(self.times, time), 1, max(len(self.times) - 1, 1)))
        if len(self.times) == 1:
            return self._over(0)(points)
        before = after - 1
        span = self.times[after] - self.times[before]
        share = float(np.clip((time - self.times[before]) / span, 0.0, 1.0))
        return (1 - share) * self._over(before)(points) + share * self._over(after)(points)

    def knots(self, segments: Floats) -> Floats:
        """Return where segments (k, 2, 2) are beside places of a line, or pass other places (k, n).

        They count from 0 to 1 along each segment; nan where a place is not on it.
        """
        start, way = segments[:, 0], segments[:, 1] - segments[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):  # segments across the line
            if self._line is not None:
                centre, along = self._line
                gone = (self.places - centre) @ along - ((start - centre) @ along)[:, None]
                return np.asarray(gone / (way @ along)[:, None])
            to = self.places - start[:, None]
            length = np.hypot(*way.T)[:, None]
            off = (way[:, None, 0] * to[..., 1] - way[:, None, 1] * to[..., 0]) / length
            passed = np.einsum("kni,ki->kn", to, way) / length**2
            return np.where(np.abs(off) < self._reach, passed, np.nan)

    def _over(self, number: int) -> Interpolation:
        along = self._line
        if along is None:
            from scipy.interpolate import LinearNDInterpolator

            found: Interpolation = LinearNDInterpolator(self._triangles, self.known[number])
            return found
        start, way = along
        order = np.argsort(places := (self.places - start) @ way)
        values, ends = self.known[number][order], places[order]

        def between(points: Floats) -> Floats:
            found = (points - start) @ way
            inside = (found >= ends[0] - self._reach) & (found <= ends[-1] + self._reach)
            sides = [np.interp(found, ends, values[:, i]) for i in (0, 1)]
            return np.where(inside[:, None], np.stack(sides, axis=1), np.nan)

        return between

    @cached_property
    def _line(self) -> tuple[Floats, Floats] | None:
        """Centre and direction of the line on which all places lie; None if they do not."""
        centre = self.places.mean(axis=0)
        _, sizes, axes = np.linalg.svd(self.places - centre)
        if len(sizes) > 1 and sizes[1] > ON_LINE * sizes[0]:
            return None
        return centre, axes[0]

    @cached_property
    def _reach(self) -> float:
        return OUTSIDE * float(np.hypot(*np.ptp(self.places, axis=0)))

    @cached_property
    def _triangles(self) -> "Delaunay":
        from scipy.spatial import Delaunay

        return Delaunay(self.places)
