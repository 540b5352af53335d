"""Which bodies may meet, and by which law: the interfaces of a scene as contact reads them.

Every two bodies meet by the interface of their materials. Where the scene has none, they must not
touch: at the start that is a fault of the scene, later it ends the run at the step before. The
sub-blocks of one block are glued and never meet.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from integration.arrays import Bools, Ints
from nmm.effects.base import Setup
from nmm.errors import SceneError
from nmm.interfaces.base import INTERFACE_LAWS, InterfaceLaw
from nmm.interfaces.restitution import damping_of

# Numbers that stand in for an interface: pieces of one block, which are glued and never meet, and
# bodies that must not touch.
GLUED, MISSING = -1, -2

# Keys of a scene's interface that every law has, and those that a law need not know.
ALWAYS = (
    "friction_angle",
    "cohesion",
    "tensile_strength",
    "bonded",
    "normal_stiffness",
    "shear_stiffness",
    "fracture_energy",
)
WHERE_GIVEN = (
    "shear_fracture_energy",
    "residual_friction_angle",
    "dilation_angle",
    "dilation_slip",
    "damping",
)


def interface_law(item: Any) -> InterfaceLaw:
    """Return the law of a scene's interface: with a fracture energy the common one softens."""
    softens = item.law == "mohr_coulomb" and item.fracture_energy is not None
    given = {name: getattr(item, name) for name in ALWAYS}
    for name in WHERE_GIVEN:
        if getattr(item, name) is not None:
            given[name] = getattr(item, name)
    if item.restitution is not None:
        given["damping"] = damping_of(item.restitution)
    name = "linear_softening" if softens else item.law
    law: InterfaceLaw = INTERFACE_LAWS.make(name, item.options, **given)
    return law


@dataclass(frozen=True)
class Pairs:
    """The interface of any two regions, by their materials.

    Attributes
    ----------
    table
        (M, M) index of the interface of two materials; MISSING where the scene has none.
    material
        (N,) of the regions.
    glued
        Whether pieces of one region are glued and never meet.
    """

    table: Ints
    material: Ints
    glued: bool

    def interface(self, one: Ints, other: Ints) -> Ints:
        """Index (m,) of the interface between regions; GLUED and MISSING are negative."""
        found = self.table[self.material[one], self.material[other]]
        return np.where(one == other, GLUED, found) if self.glued else found


def pairs_of(setup: Setup) -> Pairs:
    """Return the interfaces of a scene's materials."""
    materials = list(setup.scene.materials)
    names: Mapping[int, str] = dict(enumerate(materials))
    order = {id(item): number for number, item in enumerate(setup.scene.interfaces.values())}
    table = np.full((len(materials), len(materials)), MISSING)
    for i, j in np.ndindex(*table.shape):  # pairs of materials
        try:
            table[i, j] = order[id(setup.scene.interface(names[i], names[j]))]
        except SceneError:
            continue
    return Pairs(table, setup.region_material, setup.formulation.cover.glued)


def held_bodies(setup: Setup) -> Bools:
    """Which bodies (B,) a support holds as a whole, in both directions."""
    manifold = setup.model.manifold
    held: Bools = np.zeros(manifold.n_bodies, dtype=bool)
    for support in setup.scene.supports:  # a handful of supports
        if support.point is None and support.segment is None and len(set(support.fix)) == 2:
            regions = setup.regions(support.block)
            inside = slice(None) if regions is None else regions[manifold.element_region]
            held[manifold.element_body[inside]] = True
    return held


def no_interface(x: float, y: float) -> str:
    """Say that blocks met at a point (m) though their materials have no interface."""
    return (
        f"[interfaces]: blocks meet at ({x:.10g}, {y:.10g}) whose materials have none: "
        'expected an interface between the two: add one, or one with between = "any"'
    )
