"""The equations of a scalar field of a scene, be it temperature or water head."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse import csc_array

from covers.approximation.own_rule import own_rule
from covers.scalar.space import ScalarSpace
from integration.arrays import Bools, Floats
from nmm.assembly.places import Place, on_segment
from nmm.diffusion.determined import undetermined
from nmm.diffusion.edges import Edge, Factor
from nmm.diffusion.given import GivenField, VolumeSource
from nmm.diffusion.holding import prescribed
from nmm.diffusion.joints import Conductance, JointParts, across_blocks, across_cracks
from nmm.diffusion.matrices import integrals, products, slopes
from nmm.diffusion.problem import DiffusionProblem, field_solver
from nmm.effects.base import Setup
from nmm.effects.loading.load_factor import course_of
from nmm.errors import Fault, SceneError

JOINTS = "joints"
Values = Callable[[Floats], Floats]
"""From points (m, 2) to values (m,) of the field."""


@dataclass(frozen=True)
class GivenTable:
    """One of the scene's tables: its key, the table, and what it gives.

    Attributes
    ----------
    key
        Of its tables in the scene.
    item
        The table: name, segment, block, history.
    values
        Of the field, where it is held, given or surrounds.
    amount
        A flux, a source, or a coefficient of exchange.
    besides
        From the points of an edge that is held to a flux (m,) that they have besides.
    """

    key: str
    item: Any
    values: Values | None = None
    amount: float = 0.0
    besides: Callable[[Place], Floats] | None = None

    @property
    def factor(self) -> Factor:
        """From a time (s) to a factor."""
        return course_of(self.item.history)


@dataclass(frozen=True)
class FieldTables:
    """The tables of a scene for a field.

    Attributes
    ----------
    conductivity
        (E, 2, 2) flux for each unit of slope.
    capacity
        (E,) what a unit of volume stores for each unit of the field; None where it is steady.
    prescribed, exchanges, inflows, sources
        Tables of values, of surroundings, of fluxes and of volumes.
    conductance
        Of the joint of an interface of the scene.
    cracks
        Conductance of each crack of the scene.
    what
        Word for the field, and what would determine it, for faults.
    """

    conductivity: Floats
    capacity: Floats | None
    prescribed: Sequence[GivenTable]
    exchanges: Sequence[GivenTable]
    inflows: Sequence[GivenTable]
    sources: Sequence[GivenTable]
    conductance: Callable[[Any], Conductance]
    cracks: Sequence[Conductance]
    what: tuple[str, str, str]


def field_problem(setup: Setup, space: ScalarSpace, tables: FieldTables) -> DiffusionProblem:
    """Return the equations of a field.

    Raises
    ------
    SceneError
        A table that lies on no edge; a block whose steady field nothing determines.
    """
    model = setup.model
    edges = [*_edges(setup, space, tables), *_joints(setup, space, tables)]
    capacity = None
    if tables.capacity is not None:
        capacity = products(space, model.thickness * tables.capacity)
    found = DiffusionProblem(
        space,
        slopes(space, model.thickness * tables.conductivity),
        capacity,
        edges,
        list(_sources(setup, space, tables)),
        list(_given(setup, space, tables)),
        field_solver(model.manifold, setup.formulation.solver),
    )
    if tables.capacity is None:
        _refuse_undetermined(setup, found, tables.what)
    return found


def sloping(item: Any, value: float, points: Floats) -> Floats:
    """Values (m,) at points (m, 2): ``value`` where ``item`` is about, and its gradient."""
    slope = (points - np.array(item.about)) @ np.array(item.gradient)
    return np.asarray(value + slope)


def of_elements(setup: Setup, key: str, missing: float = 0.0) -> Floats:
    """Return a constant (E,) of the elements' materials, ``missing`` where none is given."""
    given = [getattr(item, key) for item in setup.scene.materials.values()]
    values = [missing if value is None else value for value in given]
    region = setup.model.manifold.element_region
    return np.array(values)[np.asarray(setup.region_material)[region]]


def conductivities(setup: Setup, key: str) -> Floats:
    """Return the conductivity (E, 2, 2) of the elements' materials, of axes 1 and 2 or alike."""
    along, across = of_elements(setup, key), of_elements(setup, f"{key}_2", missing=np.nan)
    across = np.where(np.isnan(across), along, across)
    angle = of_elements(setup, "axis_angle")
    axis = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    more = (along - across)[:, None, None] * axis[:, :, None] * axis[:, None, :]
    return np.asarray(across[:, None, None] * np.eye(2) + more)


def fitted(setup: Setup, space: ScalarSpace, chosen: Bools, values: Values) -> Floats:
    """Unknowns (n,) of the chosen functions nearest to a field: it itself from degree 1 on."""
    rule = own_rule(setup.model.manifold)
    rows = space.values(rule.owner, rule.points)
    sides = rows.T @ (rule.weights * values(rule.points))
    mass = csc_array(products(space, np.ones(len(setup.model.density)))[chosen][:, chosen])
    solver = field_solver(setup.model.manifold, setup.formulation.solver)
    found = np.zeros(space.n)
    found[chosen] = solver.factorise(mass).solve(sides[chosen])
    return found


def _place(setup: Setup, given: GivenTable) -> Place:
    manifold, item = setup.model.manifold, given.item
    order = 2 * manifold.degree + 2
    place = on_segment(manifold, np.array(item.segment), setup.regions(item.block), order)
    if not len(place):
        where = setup.scene.source.of_name(given.key, item.name, "segment")
        expected = "a part of the boundary of a block"
        raise SceneError(Fault(where, str(item.segment), expected, "move it onto an edge"))
    return place


def _edges(setup: Setup, space: ScalarSpace, tables: FieldTables) -> Iterator[Edge]:
    """Yield the conditions on the boundary."""
    model = setup.model
    for one in tables.prescribed:  # a handful
        if one.item.segment is not None:
            assert one.values is not None
            place = _place(setup, one)
            values = one.values(place.position)
            fixed = (space, model, tables.conductivity, place, values, one.item.name)
            edge = prescribed(*fixed, one.factor)
            yield edge if one.besides is None else replace(edge, inflow=one.besides(place))
    for one in (*tables.inflows, *tables.exchanges):  # a handful
        place = _place(setup, one)
        rows, area = space.values(place.elements, place.position), place.weight * model.thickness
        amount, none = np.full(len(place), one.amount), np.zeros(len(place))
        if one.values is None:
            yield Edge(one.item.name, rows, area, none, inflow=amount, factor=one.factor)
        else:
            given = one.values(place.position)
            yield Edge(one.item.name, rows, area, amount, given=given, factor=one.factor)


def _joints(setup: Setup, space: ScalarSpace, tables: FieldTables) -> Iterator[Edge]:
    """Yield the conditions of joints between blocks and of conducting cracks."""
    scene, materials = setup.scene, list(setup.scene.materials)
    joining = JointParts(space, setup.model, tables.conductivity)

    def conductance(a: int, b: int) -> Conductance:
        pair = (materials[setup.region_material[one]] for one in (a, b))
        try:
            return tables.conductance(scene.interface(*pair))
        except SceneError:
            return None

    yield from across_blocks(joining, conductance, JOINTS)
    # Cracks of joint sets, which insulate, are numbered after those of the scene.
    yield from across_cracks(joining, tables.cracks, JOINTS)


def _sources(setup: Setup, space: ScalarSpace, tables: FieldTables) -> Iterator[VolumeSource]:
    for one in tables.sources:  # a handful
        inside = _elements(setup, one.item.block).astype(np.float64)
        load = integrals(space, one.amount * setup.model.thickness * inside)
        yield VolumeSource(one.item.name, load, one.factor)


def _given(setup: Setup, space: ScalarSpace, tables: FieldTables) -> Iterator[GivenField]:
    """Yield prescribed fields of whole blocks."""
    for one in tables.prescribed:  # a handful
        if one.item.segment is None:
            assert one.values is not None
            inside = _elements(setup, one.item.block)
            bodies = np.unique(setup.model.manifold.element_body[inside])
            chosen = np.isin(space.body, bodies)
            unknowns = fitted(setup, space, chosen, one.values)
            yield GivenField(one.item.name, chosen, unknowns, one.factor)


def _elements(setup: Setup, block: str | None) -> Bools:
    regions, region = setup.regions(block), setup.model.manifold.element_region
    return np.ones(len(region), dtype=bool) if regions is None else regions[region]


def _refuse_undetermined(
    setup: Setup, problem: DiffusionProblem, what: tuple[str, str, str]
) -> None:
    bodies = undetermined(problem)
    if not len(bodies):
        return
    key, word, remedy = what
    manifold = setup.model.manifold
    region = manifold.element_region[manifold.element_body == bodies[0]][0]
    value = f"block {setup.region_name[region]}: nothing holds its {word}"
    expected = f"a {word} on it, or a joint that conducts to a block that has one"
    raise SceneError(Fault(setup.scene.source.place(key), value, expected, remedy))
