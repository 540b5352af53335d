"""From a scene and a formulation to a model that can be stepped."""

from dataclasses import MISSING, fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.moving.kinematics import CLASSICAL, COROTATIONAL, FINITE, SMALL, Kinematics
from nmm.assembly.state import initial_state
from nmm.effects.base import Setup
from nmm.errors import Fault, FormulationError, SceneError
from nmm.geometry.geometry import Geometry
from nmm.materials.base import MATERIAL_LAWS, Law
from nmm.model.from_polygons import BlockMatter, covered
from nmm.model.manifolds.covering import local_functions
from nmm.model.manifolds.enriching import with_growing_tips, without_opened_corners

if TYPE_CHECKING:
    from covers.cutting.cut import Cutting
    from nmm.formulation import Formulation
    from nmm.geometry.blocks import Regions
    from nmm.scene.matter.materials import Material
    from nmm.scene.model import Scene

block_functions = local_functions

ROUNDING = 1e-9
"""Of the largest entry of a stiffness, which constants give to some twelve digits."""

# Constants of a scene's material that not every law has.
WHERE_GIVEN = (
    *("yield_stress", "hardening_modulus"),
    *("softening_energy", "residual_stress", "residual_cohesion"),
    *("residual_friction_angle", "residual_dilation_angle"),
    *("cohesion", "friction_angle", "dilation_angle", "tensile_strength", "match"),
    *("viscosity", "delayed_modulus", "delayed_viscosity"),
    *("young_modulus_2", "shear_modulus", "axis_angle"),
    *("young_modulus_3", "poisson_ratio_13", "poisson_ratio_23"),
)


Blocks = tuple[tuple[str, ...], Ints]
"""Names (N,) of blocks and their materials (N,), as the scene counts them."""


def named(regions: "Regions") -> Blocks:
    """Return names and materials of blocks."""
    return tuple(regions.name), np.asarray(regions.material)


def setup_of(
    scene: "Scene",
    formulation: "Formulation",
    geometry: Geometry,
    origin: Floats,
    before: "Cutting | None" = None,
    blocks: Blocks | None = None,
) -> Setup:
    """Return what effects are built from, with a model of all blocks at rest.

    ``before`` is the last cut of the same blocks. ``blocks`` are names and materials of the blocks
    that elements have the numbers of: those of the geometry, unless these are some or pieces.
    """
    model = build_model(scene, formulation, geometry, before)
    _refuse_large_cells(scene, model)
    start = replace(initial_state(model.manifold), history=model.history())
    if scene.inertia is not None:
        start = replace(start, load_factor=1.0)
    names, material = blocks or named(geometry.regions)
    kinematics = kinematics_of(scene, formulation)
    setup = Setup(
        scene, formulation, model, geometry, names, material, start, origin, kinematics=kinematics
    )
    if not scene.masses:
        return setup
    from nmm.effects.members.masses import loaded

    return replace(setup, model=loaded(setup))


def kinematics_of(scene: "Scene", formulation: "Formulation") -> Kinematics:
    """Return how bodies move: as asked for, small in statics of bodies that nothing touches."""
    update = formulation.rotation.update
    if update == "auto":
        still = scene.inertia is None and scene.contact is None
        return SMALL if still else COROTATIONAL
    asked = {"exact": COROTATIONAL, "linear": CLASSICAL, "small": SMALL, "finite": FINITE}
    return asked[update]


def reshaped(setup: Setup, geometry: Geometry) -> Setup:
    """Return what effects are built from on another geometry of the same blocks."""
    before, blocks = setup.model.cutting, (setup.region_name, setup.region_material)
    new = setup_of(setup.scene, setup.formulation, geometry, setup.origin, before, blocks)
    return replace(setup, model=new.model, geometry=geometry, start=new.start)


def geometry_of(scene: "Scene", regions: "Regions") -> Geometry:
    """Return blocks with the cracks of their scene."""
    lines = tuple(np.array(crack.points) for crack in scene.cracks)
    bonded = tuple(number for number, crack in enumerate(scene.cracks) if crack.bonded)
    return Geometry(regions, lines, bonded=bonded)


def build_model(
    scene: "Scene",
    formulation: "Formulation",
    geometry: Geometry,
    before: "Cutting | None" = None,
) -> Model:
    """Cover a geometry and give the elements their materials; ``before`` see `setup_of`."""
    materials = scene.materials.values()
    moves = scene.loading is not None and scene.loading.motion_after_failure is not None
    has_mass = scene.gravity is not None or scene.inertia is not None or moves
    cover = formulation.cover
    if scene.fracture is not None:
        cover = with_growing_tips(cover)
    if before is not None:  # one that has changed
        cover = without_opened_corners(cover, geometry.cracks)
    sheet = BlockMatter(
        [_sound(name, material_law(item), scene) for name, item in scene.materials.items()],
        np.array([(item.density or 0.0) * has_mass for item in materials]),
        scene.plane,
        scene.thickness,
        lumped=formulation.integrator.mass == "lumped",
        finite=kinematics_of(scene, formulation).finite,
    )
    return covered(geometry, cover, sheet, before)


def _refuse_large_cells(scene: "Scene", model: Model) -> None:
    """Refuse cells for which a law has no answer, by the material's name."""
    if model.law is None or model.cell_size is None:
        return
    for number, (name, law) in enumerate(zip(scene.materials, model.laws, strict=True)):
        if not law.sized:
            continue
        try:
            law.check_size(model.cell_size[model.law == number])
        except FormulationError as error:
            told = (f"[materials.{name}] {fault}" for fault in error.faults)
            raise FormulationError(*told) from None


def _sound(name: str, law: Law, scene: "Scene") -> Law:
    """Return a law whose matrix stores energy; refuse another by the material's name."""
    stiffness = np.asarray(law.stiffness(scene.plane), dtype=float)
    fits = stiffness.shape == (3, 3) and bool(np.isfinite(stiffness).all())
    if not (fits and _stores(stiffness) and 0 < law.modulus < np.inf):
        place = scene.source.place("materials", name)
        value = f"stiffness {stiffness.tolist()} Pa, modulus {law.modulus} Pa"
        expected = "a symmetric matrix (3, 3) under which no strain gives energy, and a modulus > 0"
        raise SceneError(Fault(place, value, expected, "correct the constants or the law"))
    return law


def _stores(stiffness: Floats) -> bool:
    """Whether a matrix is symmetric and no strain has less than no energy, but for rounding."""
    rounding = ROUNDING * np.abs(stiffness).max()
    symmetric = np.abs(stiffness - stiffness.T).max() <= rounding
    return bool(symmetric and np.linalg.eigvalsh(stiffness).min() >= -rounding)


def material_law(item: "Material") -> Law:
    """Return the law of a scene's material.

    Raises
    ------
    FormulationError
        Constants that the law does not have, or lacks.
    """
    given = {name: getattr(item, name) for name in WHERE_GIVEN if getattr(item, name) is not None}
    kind = cast(Any, MATERIAL_LAWS.load(item.law))
    if is_dataclass(kind):
        known = {field.name: field for field in fields(kind) if field.init}
        if "axis_angle" not in known and (item.conductivity_2 or item.hydraulic_conductivity_2):
            given.pop("axis_angle", None)  # of conductivities alone
        for name in given:
            if name not in known:
                having = [law for law in MATERIAL_LAWS.names() if _has(law, name)]
                expected = f"a law that has it: {', '.join(having)}"
                fault = Fault(f'law "{item.law}"', name, expected, "set law, or remove it")
                raise FormulationError(fault)
        for name in WHERE_GIVEN:
            if name in known and name not in given and known[name].default is MISSING:
                fault = Fault(f'law "{item.law}"', f"no {name}", "one", f"add {name}")
                raise FormulationError(fault)
    constants = {"young_modulus": item.young_modulus, "poisson_ratio": item.poisson_ratio, **given}
    law: Law = MATERIAL_LAWS.make(item.law, item.options, **constants)
    return law


def _has(law: str, constant: str) -> bool:
    return constant in {field.name for field in fields(cast(Any, MATERIAL_LAWS.load(law)))}
