"""Tensile strength of materials as the interface of each with itself says it."""

import numpy as np

from integration.arrays import Floats
from nmm.effects.base import Setup
from nmm.errors import Fault, SceneError
from nmm.interfaces.from_scene import interface_law


def element_strength(setup: Setup) -> Floats:
    """Return the strength (E,) of the elements (Pa); infinite where no bond says one.

    Raises
    ------
    SceneError
        No material has a bond with itself.
    """
    scene = setup.scene
    found = np.full(len(scene.materials), np.inf)
    for number, name in enumerate(scene.materials):  # a handful of materials
        try:
            law = interface_law(scene.interface(name, name))
        except SceneError:
            continue
        if law.bonded and law.tensile_strength > 0:
            found[number] = law.tensile_strength
    if np.isinf(found).all():
        value, expected = "no material with a bond", "an interface of a material with itself"
        remedy = 'give one between = ["rock", "rock"] a tensile_strength and bonded = true'
        raise SceneError(Fault(scene.source.place("cohesive_zones"), value, expected, remedy))
    return found[setup.region_material[setup.model.manifold.element_region]]
