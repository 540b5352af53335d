"""Formulations that benchmarks are run under: what each changes in the scene's own."""

from typing import Any

from nmm.errors import FormulationError
from nmm.formulation import CoverTable, Formulation

_POLYNOMIALS = {"functions": "monomials"}


def _mesh(kind: str, degree: int) -> dict[str, Any]:
    return {"type": kind, "size": 0.5, **_POLYNOMIALS, "degree": degree}


CHOICES: dict[str, dict[str, dict[str, Any]]] = {
    "dda": {},
    "rigid": {"cover": {"functions": "rigid"}},
    "degree 2": {"cover": {"functions": "monomials", "degree": 2}},
    "degree 3": {"cover": {"functions": "monomials", "degree": 3}},
    "finite elements": {"cover": _mesh("triangles", 0)},
    "manifold": {"cover": _mesh("triangles", 1)},
    "manifold degree 2": {"cover": _mesh("triangles", 2)},
    "manifold degree 3": {"cover": _mesh("triangles", 3)},
    "bilinear quads": {"cover": _mesh("quads", 0)},
    "quads": {"cover": _mesh("quads", 1)},
    "quads degree 2": {"cover": _mesh("quads", 2)},
    "splines": {"cover": _mesh("bspline", 0)},
    "meshless": {"cover": _mesh("mls", 0)},
    "projected": {"cover": _mesh("triangles", 1) | {"volumetric": "projected"}},
    "projected degree 2": {"cover": _mesh("triangles", 2) | {"volumetric": "projected"}},
    "projected quads": {"cover": _mesh("quads", 1) | {"volumetric": "projected"}},
    "multipliers": {"cover": _mesh("triangles", 1), "supports": {"method": "lagrange"}},
    "multipliers degree 2": {"cover": _mesh("triangles", 2), "supports": {"method": "lagrange"}},
    "springs": {"cover": _mesh("triangles", 1), "supports": {"method": "penalty"}},
    "classical": {"rotation": {"update": "linear"}},
    "newmark": {"integrator": {"type": "newmark"}},
    "open-close": {"contact": {"options": {"iteration": "open_close"}}},
    "augmented": {"contact": {"enforcement": "augmented"}},
    "lagrange": {"contact": {"enforcement": "lagrange"}},
    "cone": {"contact": {"enforcement": "cone"}},
    "barrier": {"contact": {"enforcement": "barrier"}},
}


def chosen(name: str, base: Formulation | None = None) -> Formulation:
    """Return ``base`` (default formulation when None) with the choices called ``name``.

    Raises
    ------
    FormulationError
        When the name is not in `CHOICES`.
    """
    if name not in CHOICES:
        raise FormulationError(
            f'formulation of a benchmark: "{name}": expected one of {", ".join(CHOICES)}'
        )
    content = (base or Formulation()).model_dump(mode="json")
    for table, values in CHOICES[name].items():
        content[table] |= values
    return Formulation.model_validate(content)


def with_cover(formulation: Formulation, **keys: Any) -> Formulation:
    """Return a formulation with other values of its ``[cover]``."""
    cover = formulation.cover.model_copy(update=keys)
    return formulation.model_copy(update={"cover": cover})


def with_cover_keys(formulation: Formulation, **keys: Any) -> Formulation:
    """Return a formulation with keys of its ``[cover]`` as a file gives them, tables among them."""
    cover = CoverTable.model_validate(formulation.cover.model_dump(mode="json") | keys)
    return formulation.model_copy(update={"cover": cover})
