"""The problem of the hydraulic head in blocks, from the tables of a scene.

Heads are prescribed, water flows in, and a free surface lets pores fill and drain.
"""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats
from nmm.assembly.places import Place
from nmm.diffusion.from_scene import (
    FieldTables,
    GivenTable,
    Values,
    conductivities,
    field_problem,
    of_elements,
    sloping,
)
from nmm.diffusion.problem import DiffusionProblem
from nmm.effects.base import Setup
from nmm.errors import Fault, FormulationError, SceneError

if TYPE_CHECKING:
    from nmm.scene.tables.seepage import HeadTable
    from nmm.water.free_surface import Filling, FreeSurface

LOOSE = ("seepage", "head", "add [[heads]], or transient = true")


def head_problem(
    setup: Setup, space: ScalarSpace, filling: "Filling | None" = None
) -> DiffusionProblem:
    """Return the problem of the head, counted from the origin of the model's axes."""
    scene = setup.scene
    assert scene.seepage is not None
    stored = of_elements(setup, "specific_storage") if scene.seepage.transient else None
    conductivity = conductivities(setup, "hydraulic_conductivity")
    prescribed = [_prescribed(setup, one, filling, conductivity) for one in scene.heads]
    inflows = [GivenTable("inflows", one, amount=one.velocity) for one in scene.inflows]
    tables = FieldTables(
        conductivity=conductivity,
        capacity=stored,
        prescribed=prescribed,
        exchanges=[],
        inflows=inflows,
        sources=[],
        conductance=lambda interface: interface.leakage,
        cracks=[crack.leakage for crack in scene.cracks],
        what=LOOSE,
    )
    found = field_problem(setup, space, tables)
    if filling is None:
        return found
    from nmm.water.free_surface import FreeSurface

    surface = FreeSurface.of(found, filling)
    return surface if stored is None else _moving(setup, surface)


def filling_of(setup: Setup, space: ScalarSpace) -> "Filling":
    """Return the saturation.

    Raises
    ------
    SceneError
        A prescribed head changes in time, and with it the part of its edge open to the air.
    """
    from nmm.water.free_surface import Filling

    for one in setup.scene.heads:  # a handful
        if one.history is not None:
            place = setup.scene.source.of_name("heads", one.name, "history")
            expected = "a head that stays, with a free_surface"
            raise SceneError(Fault(place, "a history", expected, "remove it"))
    thickness = setup.model.thickness
    return Filling.of(space, thickness * conductivities(setup, "hydraulic_conductivity"))


def _prescribed(
    setup: Setup, one: "HeadTable", filling: "Filling | None", conductivity: Floats
) -> GivenTable:
    """Return a prescribed head; with a free surface the pressure is zero above the water."""
    level: Values = partial(sloping, one, one.head - float(setup.origin[1]))
    if filling is None:
        return GivenTable("heads", one, level)

    def air(points: Floats) -> Floats:
        return np.maximum(level(points), points[:, 1])

    def empty(place: Place) -> Floats:
        assert place.normal is not None
        depth = air(place.position) - place.position[:, 1]
        filled = filling.filled(depth, place.elements)
        falls = (conductivity[place.elements, :, 1] * place.normal).sum(axis=1)
        return np.asarray(-(1 - filled) * falls)

    return GivenTable("heads", one, air, besides=empty)


def _moving(setup: Setup, surface: "FreeSurface") -> DiffusionProblem:
    """Return the problem of a moving free surface.

    Raises
    ------
    FormulationError
        The time integration is not implicit: unsaturated pores have no defined flow at its start.
    """
    from nmm.water.moving_surface import MovingSurface

    asked = setup.formulation.diffusion
    if asked is not None and asked.theta != 1:
        raise FormulationError(
            f"[diffusion] theta: {asked.theta:g} with a free_surface that is transient: expected 1"
        )
    volume = setup.model.thickness * surface.space.manifold.elements.areas
    return MovingSurface.draining(surface, volume * of_elements(setup, "drainable_porosity"))
