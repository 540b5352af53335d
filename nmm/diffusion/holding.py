"""Nitsche's terms of scalar fields: prescribed values at edges, continuity across joints.

The flux is taken from donors, larger neighbours of slivers whose polynomials are continued to the
edge, and the penalty from the largest ratio of ``int (k dT/dn)^2`` to ``int k |grad T|^2`` on them,
as for displacements (`nmm.constraints`). Across joints it is averaged with the weights that make
the form positive (Annavarapu, Hautefeuille and Dolbow 2012).
"""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.sparse import csr_array, diags_array

from covers.scalar.space import ScalarSpace
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.tractions.donors import donors
from nmm.assembly.tractions.element_bounds import largest_ratio
from nmm.diffusion.edges import Edge, Factor
from nmm.diffusion.matrices import slope_integrals
from nmm.effects.loading.load_factor import steadily

# Multiple of the least penalty at which the form is positive.
SAFETY = 4.0


def prescribed(
    space: ScalarSpace,
    model: Model,
    conductivity: Floats,
    place: Place,
    given: Floats,
    name: str,
    factor: Factor = steadily,
) -> Edge:
    """Prescribe values ``given`` (m,) at points of an edge; ``conductivity`` (E, 2, 2)."""
    assert place.normal is not None
    donor = donors(model, place.elements)
    area = place.weight * model.thickness
    bound = _bounds(space, model, conductivity, [donor], [place], place.normal, area)[0]
    return Edge(
        name,
        space.values(place.elements, place.position),
        area,
        SAFETY * bound,
        _flux(space, conductivity, donor, place, place.normal),
        given,
        factor=factor,
    )


def tied(
    space: ScalarSpace,
    model: Model,
    conductivity: Floats,
    sides: Sequence[Place],
    name: str,
) -> Edge:
    """Make the field continuous at the points that two sides share."""
    normal = sides[0].normal
    assert normal is not None
    area = sides[0].weight * model.thickness
    donor = [donors(model, side.elements) for side in sides]
    bounds = _bounds(space, model, conductivity, donor, sides, normal, area)
    total = bounds[0] + bounds[1]
    share = [bounds[1 - i] / np.where(total > 0, total, 1.0) for i in (0, 1)]
    penalty = SAFETY * bounds[0] * bounds[1] / np.where(total > 0, total, 1.0)
    fluxes = [
        diags_array(share[i]) @ _flux(space, conductivity, donor[i], side, normal)
        for i, side in enumerate(sides)
    ]
    flux = csr_array(fluxes[0] + fluxes[1])
    return Edge(name, jump(space, sides), area, penalty, flux)


def jump(space: ScalarSpace, sides: Sequence[Place]) -> csr_array:
    """Rows (m, n) of the field on the first side less that on the second."""
    first, second = (space.values(side.elements, side.position) for side in sides)
    return csr_array(first - second)


def _flux(
    space: ScalarSpace, conductivity: Floats, donor: Ints, place: Place, normal: Floats
) -> csr_array:
    """Rows (m, n) of ``n . k grad T``, of the donors, along the normal of the first side."""
    return space.gradients(donor, place.position, _times(conductivity[donor], normal))


def _times(conductivity: Floats, normal: Floats) -> Floats:
    """Return tensors (m, 2, 2) times normals (m, 2)."""
    return np.asarray(np.einsum("mij,mj->mi", conductivity, normal))


def _bounds(
    space: ScalarSpace,
    model: Model,
    conductivity: Floats,
    donor: Sequence[Ints],
    sides: Sequence[Place],
    normal: Floats,
    area: Floats,
) -> list[Floats]:
    """Largest ``int (k dT/dn)^2`` over the energy of the donor (m,) of each point, by side."""
    served, number = np.unique(np.concatenate(donor), return_inverse=True)
    numbers = np.split(number.ravel(), len(donor))
    energy, slope = _element_energy(space, served, model.thickness * conductivity)
    flux = np.zeros_like(energy)
    for place, own, side in zip(numbers, donor, sides, strict=True):  # at most two sides
        values = slope(own, side.position, _times(conductivity[own], normal))
        np.add.at(flux, place, np.einsum("ma,m,mb->mab", values, area, values))
    ratio = largest_ratio(flux, energy)
    return [ratio[place] for place in numbers]


Slopes = Callable[[Ints, Floats, Floats], Floats]


def _element_energy(space: ScalarSpace, elements: Ints, factor: Floats) -> tuple[Floats, Slopes]:
    """``int grad . factor grad`` (m, L, L) of elements, and slopes (m, L) along vectors in them."""
    length = max((part.numbers.shape[1] for part in space.groups), default=0)
    total = np.zeros((len(elements), length, length))
    index = np.full(len(space.manifold.elements), -1)
    owner = np.full(len(index), -1)
    for number, part in enumerate(space.groups):  # a handful of groups
        group = part.group
        owner[group.elements], index[group.elements] = number, np.arange(len(group.elements))
        chosen = np.flatnonzero(owner[elements] == number)
        if not len(chosen):
            continue
        k, own = part.numbers.shape[1], elements[chosen]
        columns = factor[own][:, [0, 0, 1], [0, 1, 1]]
        integrals = slope_integrals(group)[group.shape[index[own]]]
        total[chosen, :k, :k] = np.einsum("mw,mwst->mst", columns, integrals)

    def slopes(own: Ints, points: Floats, along: Floats) -> Floats:
        found = np.zeros((len(own), length))
        for number, part in enumerate(space.groups):  # a handful of groups
            chosen = np.flatnonzero(owner[own] == number)
            if len(chosen):
                values = part.group.gradients(index[own[chosen]], points[chosen])
                found[chosen, : part.numbers.shape[1]] = np.einsum(
                    "msj,mj->ms", values, along[chosen]
                )
        return found

    return total, slopes
