"""From a scene and a formulation to a model that can be stepped."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.model import Model
from nmm.errors import Fault, SceneError
from nmm.materials.base import MATERIAL_LAWS, Law
from nmm.model.covering import local_functions
from nmm.model.from_polygons import covered

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene
    from nmm.scene.solids import Material

block_functions = local_functions


def build_model(scene: "Scene", formulation: "Formulation", regions: "Regions") -> Model:
    """Cover the regions and give the elements their materials."""
    materials = scene.materials.values()
    moves = scene.loading is not None and scene.loading.motion_after_failure is not None
    has_mass = scene.gravity is not None or scene.inertia is not None or moves
    return covered(
        regions,
        formulation.cover,
        [_finite(name, material_law(item), scene) for name, item in scene.materials.items()],
        scene.plane,
        cracks=[np.array(crack.points) for crack in scene.cracks],
        density=np.array([(item.density or 0.0) * has_mass for item in materials]),
        thickness=scene.thickness,
        lumped=formulation.integrator.mass == "lumped",
    )


def _finite(name: str, law: Law, scene: "Scene") -> Law:
    """Return a law whose matrix is one of numbers; refuse another by the material's name."""
    stiffness = np.asarray(law.stiffness(scene.plane), dtype=float)
    fits = stiffness.shape == (3, 3) and bool(np.isfinite(stiffness).all())
    if not (fits and 0 < law.modulus < np.inf):
        place = scene.source.place("materials", name)
        value = f"stiffness {stiffness.tolist()} Pa, modulus {law.modulus} Pa"
        expected = "a matrix (3, 3) of finite numbers, and a modulus above zero"
        raise SceneError(Fault(place, value, expected, "correct the constants or the law"))
    return law


def material_law(item: "Material") -> Law:
    """Return the law of a scene's material."""
    constants = {"young_modulus": item.young_modulus, "poisson_ratio": item.poisson_ratio}
    law: Law = MATERIAL_LAWS.make(item.law, item.options, **constants)
    return law
