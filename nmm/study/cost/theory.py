"""Orders that theory promises, to print beside observed ones."""

from collections.abc import Mapping

from nmm.errors import FormulationError
from nmm.integrators.base import INTEGRATORS

# Quantities that are an energy, or the work of the loads: off by the square of the energy norm.
ENERGIES = ("energy", "strain_energy", "external_work")


def order_in_size(
    degree: int | None, quantity: str, exponent: float | None = None
) -> tuple[float, str] | None:
    """Order in the size of a cover that spans polynomials of a degree, with its formula.

    None if unknown. The energy norm falls with the degree s + p, so an energy with its double
    (Babuska & Aziz 1972), and a displacement at a point with s + p + 1. Where displacements are
    like r^exponent at a corner or crack tip that nothing resolves, the energy norm falls with the
    exponent at most.
    """
    if degree is None:
        return None
    if quantity in ENERGIES and exponent is not None and exponent < degree:
        return 2 * exponent, f"2 lambda, lambda = {exponent:g}"
    if quantity in ENERGIES:
        return 2.0 * degree, "2 (s + p)"
    if quantity.startswith("monitor:"):
        return degree + 1.0, "s + p + 1"
    return None


def order_in_step(method: Mapping[str, str]) -> tuple[float, str] | None:
    """Order of an integrator in its step while contacts do not change; None if it says none."""
    name = method.get("integrator", "")
    try:
        return float(INTEGRATORS.make(name).order), f"order of {name}"
    except FormulationError:  # one of the user's that may not be imported here
        return None
