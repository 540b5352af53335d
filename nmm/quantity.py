"""A named quantity of a frame: its values, what they belong to, and their unit."""

from dataclasses import dataclass
from typing import Literal

from integration.arrays import Floats

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
