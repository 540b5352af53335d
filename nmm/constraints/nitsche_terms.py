"""Nitsche's tractions and penalties: against the ground with a ghost term, between bodies weighted.

Between bodies the traction is an average of both sides. With ``r_i`` the largest ratio of
``int t_i^2`` to the energy of what ``t_i`` is taken from, the integral over all edges it serves,
``k_1 = r_2 / (r_1 + r_2)`` and ``gamma >= r_1 r_2 / (r_1 + r_2)`` make the form positive
(Annavarapu, Hautefeuille and Dolbow 2012; Griebel and Schweitzer 2003 for the ratio). A side whose
ratio is bad has little weight.

The ratio is a modulus ``m_i`` times a reach ``g_i`` in 1/m. The penalty is four times the bound
with the larger reach on both sides, ``gamma = 4 g m_1 m_2 / (m_1 + m_2)``: below four times the
softer side's, whatever the other's modulus. With the reach of either side a thin side would hardly
count, and what is glued to it would give way by a quarter of its own strain where nothing pulls.

Pressures of nearly incompressible sides have terms of their own (`nmm.constraints.volume_lift`).
"""

import numpy as np
from scipy.sparse import csc_array

from covers.approximation.ghost import ghost, neighbours
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.constraints.imposition import Method
from nmm.constraints.interface import Interface
from nmm.constraints.nitsche_bounds import edge_bound, element_bounds
from nmm.constraints.traction_donors import Flux, donors, traction_rows
from nmm.constraints.volume_lift import Lift, lift

# Nitsche's penalty in (lambda + 2 mu) / h by degree of the local functions: measured to keep the
# matrix positive down to cuts of 1e-6 of a cell.
GAMMA = {0: 20.0, 1: 20.0, 2: 60.0, 3: 120.0}
# The ghost term takes lambda + 2 mu up to this many mu: a Poisson ratio of 1/3 in plane strain.
# Above it the tie would lock what it ties; `edge_bound` makes up for a softer one.
SOFTEST = 4.0
# Multiples of the least penalty with which the form is positive: twice keeps away from the limit
# and from the tolerance of the estimate; between bodies another two for how sides share an energy.
SAFETY_GROUND, SAFETY_BODIES = 2.0, 4.0

Terms = tuple[Floats, tuple[Flux, ...], csc_array | None, tuple[Lift, ...]]


def against_ground(model: Model, interface: Interface, method: Method) -> Terms:
    """Penalty (m,), traction, ghost term and pressures of a support."""
    place = interface.first
    assert place.normal is not None
    assert method.size is not None
    hard = _modulus(model)
    soft = np.minimum(hard, SOFTEST * model.elasticity[:, 2, 2])
    tie = ghost(
        model.manifold,
        _cut(model, place.elements),
        method.ghost * model.thickness * soft / method.size**2,
        model.manifold.degree,
    )
    rows = traction_rows(model, place.elements, place.position, place.normal)
    flux = Flux(place.points.body, *rows, place.elements, place.position, place.normal)
    gamma = GAMMA[min(method.degree, 3)] if method.gamma is None else method.gamma
    penalty = gamma * hard[place.elements] / method.size
    if method.gamma is None:
        bound = edge_bound(model, place, (flux.unknowns, flux.values), tie)
        penalty = np.maximum(penalty, SAFETY_GROUND * bound)
    held_up = lift(model, place.elements, place.position, place.weight)
    return penalty, (flux,), tie, () if held_up is None else (held_up,)


def between_bodies(model: Model, interface: Interface, method: Method) -> Terms:
    """Penalty (m,), tractions of both sides and their pressures of a tie."""
    normal = interface.first.normal
    assert normal is not None
    donor = [donors(model, side.elements) for side in interface.sides]
    rows = [
        traction_rows(model, own, side.position, normal)
        for own, side in zip(donor, interface.sides, strict=True)
    ]
    bounds = element_bounds(model, donor, [values for _, values in rows], interface.area)
    # Functions without strain are as a material that nothing strains.
    compliance = [_inverse(bound) for bound in bounds]
    total = compliance[0] + compliance[1]
    share = [part / np.where(total > 0, total, 1.0) for part in compliance]
    fluxes = tuple(
        Flux(
            side.points.body,
            unknowns,
            weight[:, None, None] * values,
            own,
            side.position,
            weight[:, None] * normal,
        )
        for side, (unknowns, values), weight, own in zip(
            interface.sides, rows, share, donor, strict=True
        )
    )
    factor = SAFETY_BODIES if method.gamma is None else method.gamma
    lifts = [
        lift(model, side.elements, side.position, interface.first.weight * weight)
        for side, weight in zip(interface.sides, share, strict=True)
    ]
    known = tuple(one for one in lifts if one is not None)
    return factor * _least(model, donor, bounds), fluxes, None, known


def _least(model: Model, donor: list[Ints], bounds: list[Floats]) -> Floats:
    """``g m_1 m_2 / (m_1 + m_2)`` (m,): the bound with the larger reach on both sides (Pa/m)."""
    modulus = _modulus(model)
    reach = np.maximum(bounds[0] / modulus[donor[0]], bounds[1] / modulus[donor[1]])
    give = [np.where(b > 0, 1 / modulus[d], 0.0) for b, d in zip(bounds, donor, strict=True)]
    return np.asarray(reach * _inverse(give[0] + give[1]))


def _modulus(model: Model) -> Floats:
    """Larger of the direct stiffnesses (E,) of each element, less that of pressures (Pa)."""
    return np.asarray(model.drained[:, :2, :2].max(axis=(1, 2)))


def _cut(model: Model, elements: Ints) -> Ints:
    """Elements on the edge that a cut has left, and those of their neighbours."""
    elements = np.unique(elements)
    part = ~model.cut.element_whole
    first, second = neighbours(model.manifold, elements[part[elements]])
    near = np.unique(np.concatenate([elements, first, second]))
    return np.asarray(near[part[near]])


def _inverse(values: Floats) -> Floats:
    """One over each value; zero for zero."""
    return np.asarray(np.where(values > 0, 1 / np.where(values > 0, values, 1.0), 0.0))
