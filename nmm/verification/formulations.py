"""Formulations that benchmarks are run under: what each changes in the scene's own."""

from typing import Any

from nmm.errors import FormulationError
from nmm.formulation import Formulation

_POLYNOMIALS = {"functions": "monomials"}

CHOICES: dict[str, dict[str, dict[str, Any]]] = {
    "dda": {},
    "rigid": {"cover": {"functions": "rigid"}},
    "degree 2": {"cover": {"functions": "monomials", "degree": 2}},
    "degree 3": {"cover": {"functions": "monomials", "degree": 3}},
    "finite elements": {"cover": {"type": "triangles", "size": 0.5, **_POLYNOMIALS, "degree": 0}},
    "manifold": {"cover": {"type": "triangles", "size": 0.5, **_POLYNOMIALS, "degree": 1}},
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
