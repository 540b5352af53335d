"""Orders that theory promises, to print beside observed ones."""

from collections.abc import Mapping

from nmm.integrators.base import INTEGRATORS

# Weights of these covers reproduce linear fields (s = 1), so that local functions of degree p span
# degree 1 + p; elements of scikit-fem span their degree, a block or sub-block its own.
HATS = ("triangles", "quads", "mls")
# Quantities that are an energy, or the work of the loads: off by the square of the energy norm.
ENERGIES = ("energy", "strain_energy", "external_work")


def spanned_degree(cover: str) -> int | None:
    """Degree s + p of the polynomials that a cover with its local functions spans.

    ``cover`` is in words, "triangles 1"; None for covers of which it is not known, and for blocks,
    which have no size to refine.
    """
    kind, _, rest = cover.partition(" ")
    degree = rest.split(" ")[0]
    if not degree.isdigit() or "enriched" in rest:
        return None
    if kind in HATS:
        return 1 + int(degree)
    return int(degree) if kind in ("skfem", "sub_blocks") else None


def order_in_size(
    cover: str, quantity: str, exponent: float | None = None
) -> tuple[float, str] | None:
    """Order in the size of a cover, with its formula; None if unknown.

    The energy norm falls with s + p, so an energy with its double (Babuska & Aziz 1972), and a
    displacement at a point with s + p + 1. Where displacements are like r^exponent at a corner or
    crack tip that nothing resolves, the energy norm falls with the exponent at most.
    """
    if (degree := spanned_degree(cover)) is None:
        return None
    if quantity in ENERGIES and exponent is not None and exponent < degree:
        return 2 * exponent, f"2 lambda, lambda = {exponent:g}"
    if quantity in ENERGIES:
        return 2.0 * degree, "2 (s + p)"
    if quantity.startswith("monitor:"):
        return degree + 1.0, "s + p + 1"
    return None


def order_in_step(method: Mapping[str, str]) -> tuple[float, str] | None:
    """Order of an integrator in its step while contacts do not change."""
    name = method.get("integrator", "")
    if name not in INTEGRATORS.table:
        return None
    return float(INTEGRATORS.make(name).order), f"order of {name}"
