"""The equations of a scene's temperature, counted from the reference."""

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csc_array

from covers.approximation.own_rule import own_rule
from covers.scalar.space import ScalarSpace
from integration.arrays import Bools, Floats
from nmm.assembly.places import Place, on_segment
from nmm.diffusion.determined import undetermined
from nmm.diffusion.edges import Edge, Factor, steadily
from nmm.diffusion.holding import held
from nmm.diffusion.joints import Conductance, Joining, across_blocks, across_cracks
from nmm.diffusion.matrices import integrals, products, slopes
from nmm.diffusion.problem import (
    DiffusionProblem,
    GivenField,
    VolumeSource,
    field_solver,
)
from nmm.effects.base import Setup, factor_of
from nmm.errors import Fault, SceneError

if TYPE_CHECKING:
    from nmm.scene.tables.heat import HeatTable

JOINTS = "joints"


def heat_problem(setup: Setup, space: ScalarSpace) -> DiffusionProblem:
    """Return the equations of the temperature above the reference.

    Raises
    ------
    SceneError
        A table that lies on no material; a block whose steady temperature nothing determines.
    """
    model, table = setup.model, _table(setup)
    conductivity = of_elements(setup, "conductivity")
    edges = [*_edges(setup, space, conductivity), *_joints(setup, space, conductivity)]
    capacity = None
    if table.transient:
        stored = of_elements(setup, "density") * of_elements(setup, "heat_capacity")
        capacity = products(space, model.thickness * stored)
    found = DiffusionProblem(
        space,
        slopes(space, model.thickness * conductivity),
        capacity,
        edges,
        list(_sources(setup, space)),
        list(_given(setup, space)),
        field_solver(model.manifold, setup.formulation.solver),
    )
    if not table.transient:
        _refuse_undetermined(setup, found)
    return found


def of_elements(setup: Setup, key: str) -> Floats:
    """Return a constant (E,) of the elements' materials, zero where none is given."""
    values = [getattr(item, key) or 0.0 for item in setup.scene.materials.values()]
    region = setup.model.manifold.element_region
    return np.array(values)[np.asarray(setup.region_material)[region]]


def _table(setup: Setup) -> "HeatTable":
    assert setup.scene.heat is not None
    return setup.scene.heat


def _factor(item: Any) -> Factor:
    return steadily if item.history is None else partial(factor_of, item.history)


def _place(setup: Setup, key: str, number: int, item: Any) -> Place:
    manifold, regions = setup.model.manifold, setup.regions(item.block)
    order = 2 * manifold.degree + 2
    place = on_segment(manifold, np.array(item.segment), regions, order)
    if not len(place):
        where = setup.scene.source.place(key, number, "segment")
        expected = "a part of the boundary of a block"
        raise SceneError(Fault(where, str(item.segment), expected, "move it onto an edge"))
    return place


def _edges(setup: Setup, space: ScalarSpace, conductivity: Floats) -> Iterator[Edge]:
    """Yield the conditions on the boundary."""
    scene, model, reference = setup.scene, setup.model, _table(setup).reference
    for number, item in enumerate(scene.temperatures):  # a handful
        if item.segment is not None:
            place = _place(setup, "temperatures", number, item)
            rise = _rise(item, place.position, reference)
            yield held(space, model, conductivity, place, rise, item.name, _factor(item))
    for number, flux in enumerate(scene.heat_fluxes):  # a handful
        place = _place(setup, "heat_fluxes", number, flux)
        rows, area = space.values(place.elements, place.position), place.weight * model.thickness
        inflow = np.full(len(place), flux.flux)
        none = np.zeros(len(place))
        yield Edge(flux.name, rows, area, none, inflow=inflow, factor=_factor(flux))
    for number, air in enumerate(scene.convections):  # a handful
        place = _place(setup, "convections", number, air)
        rows, area = space.values(place.elements, place.position), place.weight * model.thickness
        exchange = np.full(len(place), air.coefficient)
        given = air.temperature - reference
        yield Edge(air.name, rows, area, exchange, given=given, factor=_factor(air))


def _rise(item: Any, points: Floats, reference: float) -> Floats:
    """What a given temperature is above the reference at points (m, 2)."""
    slope = (points - np.array(item.about)) @ np.array(item.gradient)
    return np.asarray(item.temperature - reference + slope)


def _joints(setup: Setup, space: ScalarSpace, conductivity: Floats) -> Iterator[Edge]:
    """Yield what joints between blocks and the faces of cracks conduct."""
    scene, materials = setup.scene, list(setup.scene.materials)
    joining = Joining(space, setup.model, conductivity)

    def conductance(a: int, b: int) -> Conductance:
        pair = (materials[setup.region_material[one]] for one in (a, b))
        try:
            return scene.interface(*pair).conductance
        except SceneError:
            return None

    yield from across_blocks(joining, conductance, JOINTS)
    # Cracks of joint sets, which insulate, are numbered after those of the scene.
    yield from across_cracks(joining, [crack.conductance for crack in scene.cracks], JOINTS)


def _sources(setup: Setup, space: ScalarSpace) -> Iterator[VolumeSource]:
    thickness = setup.model.thickness
    for item in setup.scene.heat_sources:  # a handful
        power = item.power * thickness * _elements(setup, item.block).astype(np.float64)
        yield VolumeSource(item.name, integrals(space, power), _factor(item))


def _given(setup: Setup, space: ScalarSpace) -> Iterator[GivenField]:
    """Yield temperatures that are given in whole blocks."""
    reference = _table(setup).reference
    for item in setup.scene.temperatures:  # a handful
        if item.segment is None:
            inside = _elements(setup, item.block)
            bodies = np.unique(setup.model.manifold.element_body[inside])
            chosen = np.isin(space.body, bodies)
            rise = partial(_rise, item, reference=reference)
            yield GivenField(item.name, chosen, _fitted(setup, space, chosen, rise), _factor(item))


def _fitted(setup: Setup, space: ScalarSpace, chosen: Bools, rise: Any) -> Floats:
    """Unknowns (n,) of the chosen functions nearest to a field: it itself from degree 1 on."""
    rule = own_rule(setup.model.manifold)
    rows = space.values(rule.owner, rule.points)
    sides = rows.T @ (rule.weights * rise(rule.points))
    mass = csc_array(products(space, np.ones(len(setup.model.density)))[chosen][:, chosen])
    solver = field_solver(setup.model.manifold, setup.formulation.solver)
    found = np.zeros(space.n)
    found[chosen] = solver.factorise(mass).solve(sides[chosen])
    return found


def _elements(setup: Setup, block: str | None) -> Bools:
    regions, region = setup.regions(block), setup.model.manifold.element_region
    return np.ones(len(region), dtype=bool) if regions is None else regions[region]


def _refuse_undetermined(setup: Setup, problem: DiffusionProblem) -> None:
    loose = undetermined(problem)
    if not len(loose):
        return
    manifold = setup.model.manifold
    region = manifold.element_region[manifold.element_body == loose[0]][0]
    value = f"block {setup.region_name[region]}: nothing holds its temperature"
    expected = "a temperature, a convection, or a joint that conducts to a block that has one"
    remedy = "add [[temperatures]] or [[convections]], or transient = true"
    raise SceneError(Fault(setup.scene.source.place("heat"), value, expected, remedy))
