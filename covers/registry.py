"""Mathematical covers by name; a module is imported when its cover is asked for."""

from __future__ import annotations

from importlib import import_module

from covers.base import Cover

COVERS = {
    "triangles": "covers.triangles:Triangles",
    "quads": "covers.quads:Quads",
    "graded": "covers.graded:Graded",
    "bspline": "covers.bspline:BSplines",
    "mls": "covers.moving_least_squares:MovingLeastSquares",
}


def cover_class(name: str) -> type[Cover]:
    """Return the class of a cover from its name or from ``module:Class``.

    Every class listed makes a cover by ``regular(bounds, size, **options)``.

    Raises
    ------
    ValueError
        An unknown name, or a place that holds no cover.
    """
    place = COVERS.get(name, name)
    module, _, attribute = place.partition(":")
    if not attribute:
        raise ValueError(
            f"cover: {name!r}: expected one of {', '.join(COVERS)} or 'module:Class': "
            "correct the name"
        )
    found = getattr(import_module(module), attribute, None)
    if not (isinstance(found, type) and issubclass(found, Cover)):
        raise ValueError(
            f"cover: {name!r}: no subclass of covers.base.Cover there: name one as 'module:Class'"
        )
    return found
