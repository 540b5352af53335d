"""Laws of matter and of joints for random scenes."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import DENSITY, Site

STRONG = ("cohesion", "tensile_strength")
"""As large as the modulus: nothing breaks."""


def materials(site: Site) -> Document:
    """Return the tables of the one material of a scene, ``rock``."""
    table: dict[str, Any] = {
        "young_modulus": site.modulus,
        "poisson_ratio": float(site.random.choice([0.0, 0.2, 0.3, 0.45])),
        "density": DENSITY,
    }
    return {"materials": {"rock": {**table, **_law(site)}}}


def _law(site: Site) -> dict[str, Any]:
    modulus, shear_time = site.modulus, site.modulus * 4 * site.step
    if site.kind == "creep":
        delayed = {"delayed_modulus": modulus, "delayed_viscosity": shear_time}
        creeping: dict[str, dict[str, Any]] = {
            "maxwell": {"law": "maxwell", "viscosity": shear_time},
            "kelvin": {"law": "kelvin", "viscosity": shear_time},
            "standard_solid": {"law": "standard_solid", **delayed},
            "burgers": {"law": "burgers", "viscosity": 3 * shear_time, **delayed},
        }
        return creeping[site.one_of(*creeping)]
    if site.seldom(0.75):
        return {}
    soil = {"cohesion": 3e-4 * modulus, "friction_angle": 0.5}
    other = {"young_modulus_2": 0.4 * modulus, "shear_modulus": 0.3 * modulus, "axis_angle": 0.4}
    laws: dict[str, dict[str, Any]] = {
        "mohr_coulomb": {"law": "mohr_coulomb", **soil, "dilation_angle": 0.2},
        "drucker_prager": {"law": "drucker_prager", **soil},
        "von_mises": {
            "law": "von_mises",
            "yield_stress": 4e-4 * modulus,
            "hardening_modulus": 0.1 * modulus,
        },
        "orthotropic": {"law": "orthotropic", **other, "poisson_ratio": 0.2},
        "neo_hookean": {"law": "neo_hookean"},
    }
    return laws[site.one_of(*laws)]


def joints(site: Site) -> Document:
    """Return the table of the one interface: dry, bonded for good, brittle or softening."""
    table: dict[str, Any] = {"friction_angle": float(site.random.choice([0.0, 0.3, 0.6, 0.9]))}
    kinds = ("dry", "strong", "brittle", "softening")
    kind = "strong" if site.kind == "safety" and site.seldom(0.3) else site.one_of(*kinds)
    if site.kind == "failure":
        kind = site.one_of("brittle", "softening")
    strength = 3e-4 * site.modulus
    if kind == "strong":
        table |= {"bonded": True, **dict.fromkeys(STRONG, site.modulus)}
    elif kind != "dry":
        table |= {"bonded": True, "cohesion": 2 * strength, "tensile_strength": strength}
    if kind == "softening":
        table["law"] = site.one_of(
            "linear_softening", "bilinear_softening", "exponential_softening"
        )
        table["fracture_energy"] = strength * 3e-4 * site.height
    if site.seldom(0.4):
        table |= {"normal_stiffness": 10 * site.modulus / site.height}
        table |= {"shear_stiffness": 4 * site.modulus / site.height}
    if site.moves and site.seldom(0.2):
        table |= {"damping": 0.2} if site.seldom(0.5) else {"restitution": 0.5}
    if site.seldom(0.1):
        table |= {"residual_friction_angle": 0.5 * table["friction_angle"]}
    if site.seldom(0.1):
        least = table.get("residual_friction_angle", table["friction_angle"])
        table |= {"dilation_angle": min(0.1, least), "dilation_slip": 1e-3 * site.height}
    return {"interfaces": {"joint": table}}
