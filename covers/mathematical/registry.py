"""Mathematical covers by name; a module is imported when its cover is asked for."""

from __future__ import annotations

from importlib import import_module

from covers.mathematical.base import Cover

COVERS = {
    "triangles": "covers.mathematical.triangles:Triangles",
    "quads": "covers.mathematical.quads:Quads",
    "graded": "covers.mathematical.graded:Graded",
    "bspline": "covers.mathematical.bspline:BSplines",
    "mls": "covers.mathematical.meshless.moving_least_squares:MovingLeastSquares",
}


def cover_class(name: str) -> type[Cover]:
    """Return the class of a cover from its name.

    Every class listed makes a cover by ``regular(bounds, size, **options)``.

    Raises
    ------
    ValueError
        An unknown name.
    """
    if name not in COVERS:
        raise ValueError(f"cover: {name!r}: expected one of {', '.join(COVERS)}: correct the name")
    module, _, attribute = COVERS[name].partition(":")
    found: type[Cover] = getattr(import_module(module), attribute)
    return found
