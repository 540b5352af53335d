"""A named quantity of a frame: its values, what they belong to, and their unit."""

from dataclasses import dataclass
from typing import Literal

from integration.arrays import Floats, Ints

Place = Literal["points", "elements", "bodies", "contacts"]
PLACES: tuple[Place, ...] = ("points", "elements", "bodies", "contacts")


@dataclass(frozen=True)
class Quantity:
    """What an effect or an output declares for frames, run folders, ParaView and plots.

    Attributes
    ----------
    on
        What the rows of the values belong to: the "points" of elements (vertices), "elements",
        "bodies" (stored with each of their elements), or "contacts".
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

    place: Floats
    member: Ints
    names: tuple[str, ...]
    force: Floats
    slip: Floats
