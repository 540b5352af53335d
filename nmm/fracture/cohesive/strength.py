"""Tensile strength of materials: that of the bonded interface of each with itself."""

import numpy as np

from integration.arrays import Floats
from nmm.effects.base import Setup
from nmm.errors import Fault, SceneError
from nmm.interfaces.from_scene import interface_law


def element_strength(setup: Setup) -> Floats:
    """Return the tensile strength (E,) of the elements (Pa); infinite where no bond defines it.

    Raises
    ------
    SceneError
        No material has a bonded interface with itself.
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
