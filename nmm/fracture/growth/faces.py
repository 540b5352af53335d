"""Crack faces in a state: their place, opening and sliding."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints
from integration.plane_vectors import cross
from nmm.assembly.kept import kept_of_place
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.quantity import ENDS, Quantity


@dataclass(frozen=True)
class CrackFaces:
    """Pairs of boundary edges that are opposite faces of a crack.

    Attributes
    ----------
    crack
        (m,) number of the crack of each pair.
    left, right
        Start and end points (2 m) of the pairs on either side.
    bend
        Whether the strain turns faces: in finite strain alone.
    """

    crack: Ints
    left: MaterialPoints
    right: MaterialPoints
    bend: bool

    @classmethod
    def of(cls, model: Model) -> "CrackFaces":
        """Return all pairs of a model."""
        edges, manifold = model.cut.boundary, model.manifold
        one = np.flatnonzero((edges.crack >= 0) & (edges.opposite > np.arange(len(edges))))
        points = np.stack([edges.start[one], edges.end[one]], axis=1).reshape(-1, 2)
        left, right = (
            material_points(manifold, np.repeat(edges.element[side], 2), points)
            for side in (one, edges.opposite[one])
        )
        return cls(edges.crack[one], left, right, model.finite)

    def quantities(self, state: State) -> dict[str, Quantity]:
        """Return the quantities of the faces for a frame."""
        ends, opening, sliding = self.jumps(state)
        return {
            "faces": Quantity("cracks", ends, "m", ENDS),
            "crack": Quantity("cracks", self.crack.astype(float)),
            "opening": Quantity("cracks", opening, "m"),
            "sliding": Quantity("cracks", sliding, "m"),
        }

    def row(
        self, names: Mapping[int, str], cracks: Sequence[Floats], state: State
    ) -> dict[str, float]:
        """Return length and largest opening (m) of cracks, polylines, for a line of the history.

        ``names`` gives the name of each crack by its number.
        """
        row, opening = {}, self.widest(state)
        for number, name in names.items():  # a handful
            row[f"{name}:length"] = float(np.hypot(*np.diff(cracks[number], axis=0).T).sum())
            row[f"{name}:opening"] = float(opening[self.crack == number].max(initial=0.0))
        return row

    def jumps(self, state: State) -> tuple[Floats, Floats, Floats]:
        """Return the mid-surface (m, 4) of the faces, their opening (m,) and sliding (m,) (m).

        Opening and sliding are those at the middles of the faces; open is positive.
        """
        ends, opening, sliding = self._ends(state)
        return ends.reshape(-1, 4), opening.mean(axis=1), sliding.mean(axis=1)

    def widest(self, state: State) -> Floats:
        """Return the opening (m,) of the faces at the end where each is wider (m)."""
        return np.asarray(self._ends(state)[1].max(axis=1))

    @kept_of_place
    def _ends(self, state: State) -> tuple[Floats, Floats, Floats]:
        """Return middles (m, 2, 2), openings (m, 2) and ways along (m, 2) of the ends (m)."""
        one, two = self._flanks(state, state.deformation)
        # In small strain faces do not turn with the strain, however large it is.
        left, right = (one, two) if self.bend else self._flanks(state, None)
        both = left + right
        along = both[:, 1] - both[:, 0]
        along = (along / np.maximum(np.hypot(*along.T), 1e-300)[:, None])[:, None]
        # The material lies on the left of an edge.
        jump = one - two
        opening = cross(np.repeat(along, 2, axis=1).reshape(-1, 2), jump.reshape(-1, 2))
        return (one + two) / 2, opening.reshape(-1, 2), (along * jump).sum(axis=2)

    def _flanks(self, state: State, deformation: Floats | None) -> list[Floats]:
        """Return the ends (m, 2, 2) of the faces on either side (m)."""
        sides = (self.left, self.right)
        return [side.place(state.frames, deformation).reshape(-1, 2, 2) for side in sides]
