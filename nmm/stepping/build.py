"""From a scene and a formulation to a model that can be stepped."""

from typing import TYPE_CHECKING

import numpy as np

from covers.block_cover import block_manifold
from covers.local_functions import FUNCTIONS, LocalFunctions
from covers.manifold import Manifold
from nmm.assembly.model import Model
from nmm.errors import FormulationError
from nmm.materials.base import MATERIAL_LAWS, Law

if TYPE_CHECKING:
    from nmm.formulation import Cover, Formulation
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene
    from nmm.scene.solids import Material


def build_model(scene: "Scene", formulation: "Formulation", regions: "Regions") -> Model:
    """Cover the regions and give the elements their materials."""
    manifold = build_manifold(regions, formulation.cover)
    laws = [material_law(item) for item in scene.materials.values()]
    density = [item.density or 0.0 for item in scene.materials.values()]
    material = np.asarray(regions.material)[manifold.element_region]
    moves = scene.loading is not None and scene.loading.motion_after_failure is not None
    has_mass = scene.gravity is not None or scene.inertia is not None or moves
    elasticity = np.array([law.stiffness(scene.plane) for law in laws])
    return Model(
        manifold=manifold,
        elasticity=elasticity[material],
        density=np.array(density)[material] if has_mass else np.zeros(len(material)),
        modulus=np.array([law.modulus for law in laws])[material],
        thickness=scene.thickness,
    )


def build_manifold(regions: "Regions", cover: "Cover") -> Manifold:
    """Make the manifold that a formulation's ``[cover]`` names."""
    if cover.type != "block":
        raise FormulationError(f"[cover] type: {cover.type}: expected block")
    region = np.arange(len(regions.polygons), dtype=np.int64)
    return block_manifold(regions.polygons, region, block_functions(cover))


def block_functions(cover: "Cover") -> LocalFunctions:
    """Return the local functions that ``[cover]`` names."""
    functions = FUNCTIONS.get(cover.functions)
    if functions is None:
        raise FormulationError(
            f"[cover] functions: {cover.functions}: expected one of {', '.join(FUNCTIONS)}"
        )
    if cover.functions == "monomials" and cover.degree is None:
        raise FormulationError(
            '[cover] degree: not given: expected 0 to 3 with functions = "monomials": add degree'
        )
    return functions(1 if cover.degree is None else cover.degree)


def material_law(item: "Material") -> Law:
    """Return the law of a scene's material."""
    constants = {"young_modulus": item.young_modulus, "poisson_ratio": item.poisson_ratio}
    return MATERIAL_LAWS.load(item.law)(**constants, **item.options)
