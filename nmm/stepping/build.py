"""From a scene and a formulation to a model that can be stepped."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.model import Model
from nmm.materials.base import MATERIAL_LAWS, Law
from nmm.stepping.covering import cover_regions, local_functions

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene
    from nmm.scene.solids import Material

block_functions = local_functions


def build_model(scene: "Scene", formulation: "Formulation", regions: "Regions") -> Model:
    """Cover the regions and give the elements their materials."""
    laws = [material_law(item) for item in scene.materials.values()]
    kappa = np.array([law.kolosov(scene.plane) for law in laws])
    cracks = [np.array(crack.points) for crack in scene.cracks]
    material = np.asarray(regions.material)
    covering = cover_regions(regions, formulation.cover, cracks, kappa[material])
    manifold = covering.manifold
    density = [item.density or 0.0 for item in scene.materials.values()]
    material = material[manifold.element_region]
    moves = scene.loading is not None and scene.loading.motion_after_failure is not None
    has_mass = scene.gravity is not None or scene.inertia is not None or moves
    elasticity = np.array([law.stiffness(scene.plane) for law in laws])
    return Model(
        manifold=manifold,
        elasticity=elasticity[material],
        density=np.array(density)[material] if has_mass else np.zeros(len(material)),
        modulus=np.array([law.modulus for law in laws])[material],
        thickness=scene.thickness,
        cut=covering.cut,
        lumped=formulation.integrator.mass == "lumped",
    )


def material_law(item: "Material") -> Law:
    """Return the law of a scene's material."""
    constants = {"young_modulus": item.young_modulus, "poisson_ratio": item.poisson_ratio}
    law: Law = MATERIAL_LAWS.make(item.law, item.options, **constants)
    return law
