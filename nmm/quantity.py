"""A named quantity of a frame: its values, what they belong to, and their unit."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from integration.arrays import Floats, Ints

Place = Literal["points", "elements", "bodies", "contacts", "members", "cracks", "tips"]
PLACES: tuple[Place, ...] = (
    *("points", "elements", "bodies", "contacts"),
    *("members", "cracks", "tips"),
)
APART: tuple[Place, ...] = ("members", "cracks", "tips")
"""Those of which a frame has as many as its quantities say, and where they lie."""

ENDS = ("x1", "y1", "x2", "y2")
"""Components of a quantity that says where both ends of segments are."""
SPOT = ("x", "y")
"""Components of one that says where points are."""


@dataclass(frozen=True)
class Quantity:
    """What an effect or an output declares for frames, run folders, ParaView and plots.

    Attributes
    ----------
    on
        What the rows of the values belong to: the "points" of elements (vertices), "elements",
        "bodies" (stored with each of their elements), "contacts", "members": segments of what
        connects points (`MemberSegments`), "cracks": segments of their faces, or their "tips".
    values
        (n,) numbers or (n, k) of k components; nan where there is none.
    unit
        SI, such as "Pa"; empty without.
    components
        (k,) names of the components; empty for numbers and for vectors (x, y).
    """

    on: Place
    values: Floats
    unit: str = ""
    components: tuple[str, ...] = ()

    def moved(self, by: Floats) -> "Quantity":
        """Return it where all is moved ``by`` (2,): another one if it says where things are."""
        if self.components not in (ENDS, SPOT):
            return self
        return replace(self, values=self.values + np.tile(by, len(self.components) // 2))


@dataclass(frozen=True)
class MemberSegments:
    """Members between points as segments of a frame, with what they carry.

    Attributes
    ----------
    place
        (m, 2, 2) where their ends are (m).
    member, names
        The member (m,) that each is a part of, and what it is called.
    force
        (m,) axial, tension positive (N).
    slip
        (m,) along what it lies in (m).
    """

    ENDS: ClassVar[str] = "members:ends"
    """Name of the quantity that says where segments are: x and y of both ends."""

    place: Floats
    member: Ints
    names: tuple[str, ...]
    force: Floats
    slip: Floats

    @classmethod
    def joined(cls, parts: Sequence["MemberSegments"]) -> "MemberSegments":
        """Return the segments of several effects, whose members are numbered on."""
        first = np.cumsum([0, *(len(part.names) for part in parts)])
        return cls(
            np.concatenate([part.place for part in parts]),
            np.concatenate([part.member + at for part, at in zip(parts, first, strict=False)]),
            tuple(name for part in parts for name in part.names),
            np.concatenate([part.force for part in parts]),
            np.concatenate([part.slip for part in parts]),
        )

    @property
    def quantities(self) -> dict[str, Quantity]:
        """What a frame holds of them."""
        return {
            self.ENDS: Quantity("members", self.place.reshape(-1, 4), "m", ENDS),
            "members:number": Quantity("members", self.member.astype(float)),
            "members:force": Quantity("members", self.force, "N"),
            "members:slip": Quantity("members", self.slip, "m"),
        }
