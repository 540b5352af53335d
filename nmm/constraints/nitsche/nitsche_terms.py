"""Nitsche's tractions and penalties: against the ground with a ghost term, between bodies weighted.

Between bodies the traction is an average of both sides (`nmm.assembly.tractions.average`) and the
penalty four times the least one. Pressures of nearly incompressible sides have terms of their own
(`nmm.constraints.nitsche.volume_lift`).
"""

import numpy as np
from scipy.sparse import csc_array

from covers.approximation.ghost import ghost, neighbours
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.tractions.average import AverageTraction, direct_modulus
from nmm.assembly.tractions.donors import Flux, traction_rows
from nmm.assembly.tractions.element_bounds import element_bounds
from nmm.constraints.imposition import Method
from nmm.constraints.interface import Interface
from nmm.constraints.nitsche.nitsche_bounds import edge_bound
from nmm.constraints.nitsche.volume_lift import PressureLift, lift

# Nitsche's penalty in (lambda + 2 mu) / h by degree of the local functions: measured to keep the
# matrix positive down to cuts of 1e-6 of a cell.
GAMMA = {0: 20.0, 1: 20.0, 2: 60.0, 3: 120.0}
# The ghost term takes lambda + 2 mu up to this many mu: a Poisson ratio of 1/3 in plane strain.
# Above it the tie would lock what it ties; `edge_bound` makes up for a softer one.
SOFTEST = 4.0
# Multiples of the least penalty with which the form is positive: twice keeps away from the limit
# and from the tolerance of the estimate; between bodies another two for how sides share an energy.
SAFETY_GROUND, SAFETY_BODIES = 2.0, 4.0

Terms = tuple[Floats, tuple[Flux, ...], csc_array | None, PressureLift | None]


def against_ground(model: Model, interface: Interface, method: Method) -> Terms:
    """Penalty (m,), traction, ghost term and pressures of a support."""
    place = interface.first
    assert place.normal is not None
    assert method.size is not None
    hard = direct_modulus(model)
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
    # No edge asks for more than the one of its elements that asks most. Elements that are cut small
    # ask for too much: what their neighbours store counts then, and the edge is asked as a whole.
    whole = tie.nnz == 0
    if method.gamma is None and not (whole and _within(penalty, model, place, flux)):
        bound = edge_bound(model, place, (flux.unknowns, flux.values), tie)
        penalty = np.maximum(penalty, SAFETY_GROUND * bound)
    held_up = lift(model, [(place.elements, place.position, place.weight)])
    return penalty, (flux,), tie, held_up


def _within(penalty: Floats, model: Model, place: Place, flux: Flux) -> bool:
    """Whether a penalty (m,) is large enough whatever its elements' neighbours store."""
    area = place.weight * model.thickness
    bound = element_bounds(model, [place.elements], [flux.values], area)[0]
    return bool(SAFETY_GROUND * bound.max(initial=0.0) <= penalty.min(initial=np.inf))


def between_bodies(model: Model, interface: Interface, method: Method) -> Terms:
    """Penalty (m,), tractions of both sides and their pressures of a tie."""
    normal = interface.first.normal
    assert normal is not None
    sides = interface.sides
    found = AverageTraction.of(
        model,
        [side.elements for side in sides],
        [side.position for side in sides],
        normal,
        interface.area,
        acted=interface.acted,
    )
    factor = SAFETY_BODIES if method.gamma is None else method.gamma
    held_up = lift(
        model,
        [
            (side.elements, side.position, interface.first.weight * weight)
            for side, weight in zip(sides, found.share, strict=True)
        ],
    )
    return factor * found.least, found.fluxes, None, held_up


def _cut(model: Model, elements: Ints) -> Ints:
    """Elements on the edge that a cut has left, and those of their neighbours."""
    elements = np.unique(elements)
    part = ~model.cut.element_whole
    first, second = neighbours(model.manifold, elements[part[elements]])
    near = np.unique(np.concatenate([elements, first, second]))
    return np.asarray(near[part[near]])
