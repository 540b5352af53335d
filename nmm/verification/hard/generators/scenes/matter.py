"""Laws of matter and of joints for random scenes."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.place import DENSITY, Place

STRONG = ("cohesion", "tensile_strength")
"""As large as the modulus: nothing breaks."""


def materials(place: Place) -> Document:
    """Return the tables of the one material of a scene, ``rock``."""
    table: dict[str, Any] = {
        "young_modulus": place.modulus,
        "poisson_ratio": float(place.random.choice([0.0, 0.2, 0.3, 0.45])),
        "density": DENSITY,
    }
    return {"materials": {"rock": {**table, **_law(place)}}}


def _law(place: Place) -> dict[str, Any]:
    modulus, shear_time = place.modulus, place.modulus * 4 * place.step
    if place.kind == "creep":
        delayed = {"delayed_modulus": modulus, "delayed_viscosity": shear_time}
        return {
            "maxwell": {"law": "maxwell", "viscosity": shear_time},
            "kelvin": {"law": "kelvin", "viscosity": shear_time},
            "standard_solid": {"law": "standard_solid", **delayed},
            "burgers": {"law": "burgers", "viscosity": 3 * shear_time, **delayed},
        }[place.one_of("maxwell", "kelvin", "standard_solid", "burgers")]
    if place.seldom(0.75):
        return {}
    soil = {"cohesion": 3e-4 * modulus, "friction_angle": 0.5}
    other = {"young_modulus_2": 0.4 * modulus, "shear_modulus": 0.3 * modulus, "axis_angle": 0.4}
    return {
        "mohr_coulomb": {"law": "mohr_coulomb", **soil, "dilation_angle": 0.2},
        "drucker_prager": {"law": "drucker_prager", **soil},
        "von_mises": {
            "law": "von_mises",
            "yield_stress": 4e-4 * modulus,
            "hardening_modulus": 0.1 * modulus,
        },
        "orthotropic": {"law": "orthotropic", **other, "poisson_ratio": 0.2},
        "neo_hookean": {"law": "neo_hookean"},
    }[place.one_of("mohr_coulomb", "drucker_prager", "von_mises", "orthotropic", "neo_hookean")]


def joints(place: Place) -> Document:
    """Return the table of the one interface: dry, bonded for good, brittle or softening."""
    table: dict[str, Any] = {"friction_angle": float(place.random.choice([0.0, 0.3, 0.6, 0.9]))}
    kinds = ("dry", "strong", "brittle", "softening")
    kind = "strong" if place.kind == "safety" and place.seldom(0.3) else place.one_of(*kinds)
    if place.kind == "failure":
        kind = place.one_of("brittle", "softening")
    strength = 3e-4 * place.modulus
    if kind == "strong":
        table |= {"bonded": True, **dict.fromkeys(STRONG, place.modulus)}
    elif kind != "dry":
        table |= {"bonded": True, "cohesion": 2 * strength, "tensile_strength": strength}
    if kind == "softening":
        table["law"] = place.one_of(
            "linear_softening", "bilinear_softening", "exponential_softening"
        )
        table["fracture_energy"] = strength * 3e-4 * place.height
    if place.seldom(0.4):
        table |= {"normal_stiffness": 10 * place.modulus / place.height}
        table |= {"shear_stiffness": 4 * place.modulus / place.height}
    if place.moves and place.seldom(0.2):
        table |= place.random.choice([{"damping": 0.2}, {"restitution": 0.5}])
    if place.seldom(0.1):
        table |= {"residual_friction_angle": 0.5 * table["friction_angle"]}
    if place.seldom(0.1):
        table |= {"dilation_angle": 0.1, "dilation_slip": 1e-3 * place.height}
    return {"interfaces": {"joint": table}}
