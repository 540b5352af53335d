"""The parallel stress T at a crack tip, and its effect on the kink of a segment of finite length.

The end of a segment of length ``l`` that kinks by an angle ``t`` has

    K_II(t) = cos(t / 2) (K_I sin t + K_II (3 cos t - 1)) / 2 - T sqrt(8 l / pi) sin t cos t

to first order (Cotterell and Rice 1980; Amestoy and Leblond 1992 for the term of T). Where T is
compressive, it drives a deviation back, the more so the longer the segment: an angle from K_I and
K_II alone overshoots, and the path zigzags however short segments are. The angle that leaves K_II =
0 at the end of the segment does not.

T is the stress along the crack minus the stress across it, that is minus the traction on its faces:
a hydrostatic pressure turns no crack.
"""

from collections.abc import Sequence

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.material_points import material_points
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.fracture.growth.tips.intensities import tip_moduli

# Bisections that find an angle to rounding.
HALVINGS = 60
# Forces off the line behind a tip by less than this share of the length act on the faces.
ON_LINE = 1e-6


def parallel_stress(
    model: Model,
    state: State,
    tips: Ints,
    behind: float,
    pushes: AppliedForces,
    stresses: Sequence[StressAt] = (),
) -> Floats:
    """Return the parallel stress T (k,) at crack tips (Pa).

    On the faces the strain along the crack that goes with K_I is zero, and that with K_II is of
    opposite sign on both. So the mean strain of both faces is that of T and of the pressure p on
    them; with added stresses s that do not follow from the strain,
    T = E' strain + (1 - nu') p + s_along - nu' s_across.

    Parameters
    ----------
    tips
        (k,) numbers among ``model.cut.tips``.
    behind
        Length behind the tip over which the strain is averaged (m); the crack is straight there.
    pushes
        Forces on the faces, in global axes.
    stresses
        Stresses that do not follow from the strain.
    """
    at = model.cut.tips
    kappa, stiff = tip_moduli(model, at.element[tips])
    contraction = (3 - kappa) / (1 + kappa)
    found = np.zeros(len(tips))
    for number, tip in enumerate(tips):  # a handful of tips
        element, place = _faces_behind(model, int(tip), behind)
        points, way = material_points(model.manifold, element, place), at.direction[tip]
        along = points.rows.apply(state.deformation) @ way
        found[number] = stiff[number] * (along[0] - along[1:].mean()) / behind
        pressure = _pressure_behind(model, state, int(tip), behind, pushes)
        rest = [stress(element[1:], place[1:], state.time) for stress in stresses]
        of_rest = _of_stresses(rest, way, contraction[number])
        found[number] += (1 - contraction[number]) * pressure + of_rest
    return found


def kink_without_end_shear(
    angle: Floats, opening: Floats, sliding: Floats, parallel: Floats, length: float
) -> Floats:
    """Return the kink angles (n,) of segments at whose ends K_II is zero (rad).

    Each lies between straight ahead and the ``angle`` (n,) of the criterion; with a tensile T the
    latter stays. A closed crack counts with K_I = 0.

    Parameters
    ----------
    angle
        (n,) kink angles of the criterion (rad).
    opening, sliding
        (n,) K_I and K_II (Pa m^1/2).
    parallel
        (n,) parallel stresses T (Pa).
    length
        Of the segments (m).
    """
    driven, opening = parallel < 0, np.maximum(opening, 0.0)
    part = np.where(driven, -parallel, 0.0) * np.sqrt(8 * length / np.pi)

    def shear(t: Floats) -> Floats:
        by_kink = np.cos(t / 2) / 2 * (opening * np.sin(t) + sliding * (3 * np.cos(t) - 1))
        return np.asarray(by_kink + part * np.sin(t) * np.cos(t))

    low, high = np.zeros_like(angle), angle.copy()
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        # Straight ahead K_II is that of the tip.
        before = np.sign(shear(middle)) == np.sign(sliding)
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return np.where(driven, high, angle)


def _pressure_behind(
    model: Model, state: State, tip: int, behind: float, pushes: AppliedForces
) -> float:
    """Mean pressure (Pa) on both faces within a length behind a tip."""
    tips, manifold = model.cut.tips, model.manifold
    end, way = tips.point[tip], tips.direction[tip]
    to_left = np.array([-way[1], way[0]])
    start, last = ((end - place) @ way for place in (pushes.start, pushes.end))
    off = np.abs((pushes.start + pushes.end) / 2 @ to_left - end @ to_left)
    low, high = np.minimum(start, last), np.maximum(start, last)
    within = np.clip(high, 0, behind) - np.clip(low, 0, behind)
    body = int(manifold.element_body[tips.element[tip]])
    of_body = manifold.element_body[pushes.element] == body
    near = np.flatnonzero((within > 0) & (off < ON_LINE * behind) & of_body)
    one = pushes.take(near)
    force = state.frames.to_body(np.full(len(near), body), one.force) @ to_left
    side = np.sign((manifold.elements.centroids[one.element] - end) @ to_left)
    share = within[near] / (high - low)[near]
    return float((side * force * share).sum() / (2 * behind * model.thickness))


def _of_stresses(stresses: Sequence[Floats], way: Floats, contraction: float) -> float:
    """Contribution (Pa) of added stresses (2, 3) on both faces."""
    along = np.array([way[0] ** 2, way[1] ** 2, 2 * way[0] * way[1]])
    across = np.array([way[1] ** 2, way[0] ** 2, -2 * way[0] * way[1]])
    weights = along - contraction * across
    return float(sum((one @ weights).mean() for one in stresses))


def _faces_behind(model: Model, tip: int, behind: float) -> tuple[Ints, Floats]:
    """Return elements (3,) and places (3, 2): at the tip, and on both faces ``behind`` it (m)."""
    tips, edges = model.cut.tips, model.cut.boundary
    end = tips.point[tip]
    place = end - behind * tips.direction[tip]
    face = np.flatnonzero(edges.crack == tips.crack[tip])
    start, way = edges.start[face], edges.end[face] - edges.start[face]
    share = ((place - start) * way).sum(axis=1) / (way**2).sum(axis=1)
    off = np.hypot(*(start + np.clip(share, 0, 1)[:, None] * way - place).T)
    side = way @ tips.direction[tip] > 0
    both = [face[np.flatnonzero(on)[np.argmin(off[on])]] for on in (side, ~side)]
    element = np.array([tips.element[tip], *edges.element[both]])
    return element, np.array([end, place, place])
