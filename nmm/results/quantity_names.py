"""Names of the numbers that are read off a run, by studies and by references of a scene alike.

A name is that of a number of the summary, or of a column of the history, which stands for its last
value; ``max:column`` and ``min:column`` are its extremes, ``energy`` is the elastic energy at the
end.
"""

from collections.abc import Callable

from integration.arrays import Floats

ENERGY = "energy"
REDUCED: dict[str, Callable[[Floats], float]] = {
    "": lambda column: float(column[-1]),
    "max": lambda column: float(column.max()),
    "min": lambda column: float(column.min()),
}
"""What makes a number of the values (n,) of a column, by what stands before its name."""


def parted(name: str) -> tuple[str, str]:
    """Return the key of `REDUCED` and the number or column that a name is of."""
    if name == ENERGY:
        return "", "strain_energy"
    reduction, _, column = name.partition(":")
    return (reduction, column) if reduction and reduction in REDUCED else ("", name)
