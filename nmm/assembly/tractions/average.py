"""The weighted average of both sides' tractions on shared edges, and the penalty it asks for.

With ``r_i`` the largest ratio of ``int t_i^2`` to the energy of what ``t_i`` is taken from, the
integral over all edges it serves, the weights ``k_1 = r_2 / (r_1 + r_2)`` and a penalty of at least
``r_1 r_2 / (r_1 + r_2)`` make Nitsche's form positive (Annavarapu, Hautefeuille and Dolbow 2012;
Griebel and Schweitzer 2003 for the ratio). A side whose ratio is bad has little weight.

The ratio is a modulus ``m_i`` times a reach ``g_i`` in 1/m. The least penalty is taken with the
larger reach on both sides, ``g m_1 m_2 / (m_1 + m_2)``: below the softer side's, whatever the
other's modulus. With the reach of either side a thin side would hardly count, and what is glued to
it would give way by a quarter of its own strain where nothing pulls.

A face on which a load or a support exerts ``t_i`` hands on ``sigma_i n_i - t_i``. Where that is so
on one side alone its weight is zero, and the traction is the other side's, which no ``t_i`` is part
of: Nitsche's form is consistent with any weights that sum to one (Hansbo and Hansbo 2002), and with
one side it needs the whole ``r`` of that side as its penalty.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.tractions.donors import Flux, donors, traction_rows
from nmm.assembly.tractions.element_bounds import element_bounds


@dataclass(frozen=True)
class AverageTraction:
    """Traction on the first side of shared edges, from both.

    Attributes
    ----------
    fluxes
        What either side gives, times its weight.
    share
        (m,) weight of either side; zero where neither has stress.
    least
        (m,) penalty (Pa/m) from which on Nitsche's form is positive.
    """

    fluxes: tuple[Flux, ...]
    share: tuple[Floats, ...]
    least: Floats

    @classmethod
    def of(
        cls,
        model: Model,
        elements: Sequence[Ints],
        positions: Sequence[Floats],
        normal: Floats,
        area: Floats,
        reach: Sequence[Floats] | None = None,
        acted: Sequence[Bools] | None = None,
    ) -> "AverageTraction":
        """Average the tractions at points of both sides.

        Parameters
        ----------
        elements, positions
            (m,) elements and (m, 2) places, for each side.
        normal
            (m, 2) outward from the first side in the reference place.
        area
            (m,) that each point stands for (m2).
        reach
            (m,) lengths (m), for each side: the bounds of an element's edges go as their inverse.
            None makes them all the same.
        acted
            (m,) whether something else acts on the face, for each side; None where nothing does.
        """
        donor = [donors(model, own) for own in elements]
        rows = [
            traction_rows(model, own, place, normal)
            for own, place in zip(donor, positions, strict=True)
        ]
        bounds = element_bounds(model, donor, [values for _, values in rows], area, reach)
        # Functions without strain are as a material that nothing strains.
        compliance = [_inverse(bound) for bound in bounds]
        if acted is not None:
            compliance = _without_acted(compliance, acted)
        total = compliance[0] + compliance[1]
        share = tuple(part / np.where(total > 0, total, 1.0) for part in compliance)
        body = model.manifold.element_body
        fluxes = tuple(
            Flux(
                body[own],
                unknowns,
                weight[:, None, None] * values,
                own,
                place,
                weight[:, None] * normal,
            )
            for own, place, (unknowns, values), weight in zip(
                donor, positions, rows, share, strict=True
            )
        )
        return cls(fluxes, share, _least(model, donor, bounds, compliance))


def direct_modulus(model: Model) -> Floats:
    """Larger of the direct stiffnesses (E,) of each element, less that of pressures (Pa)."""
    return np.asarray(model.drained[:, :2, :2].max(axis=(1, 2)))


def _without_acted(compliance: Sequence[Floats], acted: Sequence[Bools]) -> list[Floats]:
    """Leave out (m,) the side on whose face alone something acts, where the other has stress."""
    (one, two), (at_one, at_two) = compliance, acted
    left_out = at_one & ~at_two & (two > 0), at_two & ~at_one & (one > 0)
    return [np.where(out, 0.0, own) for own, out in zip((one, two), left_out, strict=True)]


def _least(
    model: Model, donor: Sequence[Ints], bounds: Sequence[Floats], counts: Sequence[Floats]
) -> Floats:
    """``g m_1 m_2 / (m_1 + m_2)`` (m,): the bound with the larger reach on both sides (Pa/m).

    It is ``g m`` of the only side that ``counts`` (m,) where the other one does not.
    """
    modulus = direct_modulus(model)
    reach = np.maximum(bounds[0] / modulus[donor[0]], bounds[1] / modulus[donor[1]])
    give = [np.where(c > 0, 1 / modulus[d], 0.0) for c, d in zip(counts, donor, strict=True)]
    return np.asarray(reach * _inverse(give[0] + give[1]))


def _inverse(values: Floats) -> Floats:
    """One over each value; zero for zero."""
    return np.asarray(np.where(values > 0, 1 / np.where(values > 0, values, 1.0), 0.0))
