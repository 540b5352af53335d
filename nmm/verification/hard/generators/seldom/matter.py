"""Seldom keys of matter and joints: softening, other directions, what water leaves, two rocks."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import Site

ACROSS = {"young_modulus_3": 0.5, "poisson_ratio_13": 0.1, "poisson_ratio_23": 0.15}
"""Of orthotropic matter: the modulus as a share of that along axis 1."""


def softening(scene: Document, site: Site) -> Document:
    """Let matter that flows lose strength."""
    rock = scene["materials"]["rock"]
    if scene["plane"] != "strain" or rock.get("law") not in LEFT:
        return {}
    rock = {key: value for key, value in rock.items() if key != "hardening_modulus"}
    left = {key: 0.4 * rock[key[9:]] for key in LEFT[rock["law"]] if key[9:] in rock}
    energy = 1e-7 * site.modulus * site.height
    softer = {**rock, "softening_energy": energy, **left}
    return {"materials": {**scene["materials"], "rock": softer}}


LEFT = {
    "mohr_coulomb": ("residual_cohesion", "residual_friction_angle", "residual_dilation_angle"),
    "drucker_prager": ("residual_cohesion", "residual_friction_angle"),
    "von_mises": (),
}
"""What is left of the strength of a law."""


def cut_off(scene: Document, site: Site) -> Document:
    """Let soil bear little tension, and a cone meet the corners of the hexagon."""
    rock = scene["materials"]["rock"]
    if rock.get("law") not in ("mohr_coulomb", "drucker_prager"):
        return {}
    more: dict[str, Any] = {"tensile_strength": 1e-4 * site.modulus}
    if rock["law"] == "drucker_prager":
        more["match"] = site.one_of("plane_strain", "compression", "extension")
    return _rock(scene, more)


def out_of_plane(scene: Document, site: Site) -> Document:
    """Give orthotropic matter another stiffness out of the plane."""
    rock = scene["materials"]["rock"]
    if rock.get("law") != "orthotropic":
        return {}
    return _rock(scene, {**ACROSS, "young_modulus_3": ACROSS["young_modulus_3"] * site.modulus})


def along_axes(scene: Document, site: Site) -> Document:
    """Let heat and water pass along one direction more easily than along the other."""
    rock, more = scene["materials"]["rock"], dict[str, Any]()
    for key in ("conductivity", "hydraulic_conductivity"):
        if key in rock:
            more[f"{key}_2"] = 0.2 * rock[key]
    return _rock(scene, {"axis_angle": 0.4, **more}) if more else {}


def of_two_rocks(scene: Document, site: Site) -> Document:
    """Let every second block be of a weaker rock, with a joint of its own between both."""
    if len(scene["blocks"]) < 2 or "splitting" in scene:
        return {}
    rock, joint = scene["materials"]["rock"], scene["interfaces"]["joint"]
    weak = {**rock, "young_modulus": 0.3 * rock["young_modulus"], "density": 1500.0}
    blocks = [
        {**one, "material": "weak"} if number % 2 else one
        for number, one in enumerate(scene["blocks"])
    ]
    between = {**joint, "between": ["rock", "weak"], "friction_angle": 0.5}
    between |= {"dilation_angle": 0.0} if "dilation_angle" in joint else {}
    return {
        "materials": {**scene["materials"], "weak": weak},
        "interfaces": {**scene["interfaces"], "seam": between},
        "blocks!": blocks,
    }


def slid(scene: Document, site: Site) -> Document:
    """Give bonds another energy of sliding than of opening."""
    joint = scene["interfaces"]["joint"]
    if "fracture_energy" not in joint:
        return {}
    more = {"shear_fracture_energy": 5 * joint["fracture_energy"]}
    return {"interfaces": {**scene["interfaces"], "joint": {**joint, **more}}}


def leaky(scene: Document, site: Site) -> Document:
    """Let heat and water pass cracks and joints with a drop."""
    made: Document = {}
    keys = {"heat": "conductance", "seepage": "leakage"}
    passed = {key: 1.0 / site.height for table, key in keys.items() if table in scene}
    if passed and "cracks" in scene:
        made["cracks!"] = [{**one, **passed} for one in scene["cracks"]]
    elif passed:
        joint = {**scene["interfaces"]["joint"], **passed}
        made["interfaces"] = {**scene["interfaces"], "joint": joint}
    return made


def _rock(scene: Document, more: Document) -> Document:
    return {"materials": {**scene["materials"], "rock": {**scene["materials"]["rock"], **more}}}
