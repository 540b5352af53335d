"""Stress intensity factors of cracks by the interaction integral, in the form of a domain.

With the auxiliary fields of unit K_I and K_II (Williams 1957), ``q`` 1 near the tip and 0 at the
radius of the domain, and axes 1 ahead of the crack and 2 across it (Yau, Wang and Corten 1980;
Moran and Shih 1987; Shih and Asaro 1988)

    I = int (s_ij v_i,1 + r_ij u_i,1 - s_mn e(v)_mn delta_1j) q_,j - b_i v_i,1 q  dA
        - int_faces t_i v_i,1 q  ds,     K = E' I / 2,

``s`` the stress and ``b`` the body force of the displacement ``u``, ``r`` the stress of the
auxiliary displacement ``v``, ``t`` the traction on the faces of the crack.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from covers.approximation.enrichment import Enrichment, singular_fields
from covers.cutting.cut_cells import CutCells
from covers.local_functions.crack_tip_functions import crack_tip_functions
from integration.arrays import Floats, Ints
from integration.rules import polygon_rule
from integration.segments import segment_rule
from integration.singular import tip_rule
from nmm.assembly.model import Model
from nmm.errors import NmmError
from nmm.fracture.surroundings import nearest_obstacle

Field = Callable[[Floats], Floats]

# Degree to which smooth parts are integrated.
ORDER = 12
# ``q`` is 1 up to this part of the radius, and falls smoothly to 0 from there on.
INNER = 0.3
# Part of its radius by which a domain may touch what it must not hold.
NEAR = 1e-9


@dataclass(frozen=True)
class StressIntensity:
    """Stress intensity factors of a tip.

    Attributes
    ----------
    opening, sliding
        K_I and K_II (Pa m^1/2).
    release_rate
        Energy release rate J = (K_I^2 + K_II^2) / E' (J/m2).
    point, direction
        (2,) tip and the direction ahead of it.
    """

    opening: float
    sliding: float
    release_rate: float
    point: Floats
    direction: Floats


def stress_intensity(
    model: Model,
    unknowns: Floats,
    tip: int,
    radius: float,
    *,
    kappa: float,
    body_force: Field | None = None,
    face_traction: Callable[[Floats, Floats], Floats] | None = None,
    pressure: Floats | None = None,
) -> StressIntensity:
    """Return the stress intensity factors at a tip of the model's cracks.

    Parameters
    ----------
    model, unknowns
        A model on a cut mesh and its displacements.
    tip
        Number among ``model.cut.tips``.
    radius
        Of the domain (m): inside the body, and short of other tips, other cracks and kinks.
    kappa
        Kolosov's constant (`nmm.materials.base.Law.kolosov`).
    body_force, face_traction
        Functions of points, and of points and outward normals, as loaded; None is none.
    pressure
        (k,) on the patches of projected volumes, see `nmm.assembly.errors.stresses`.

    Raises
    ------
    NmmError
        A tip that does not exist; a domain that holds more than the material about one straight
        crack, whose integral would be that of something else.
    """
    count = len(model.cut.tips)
    if not 0 <= tip < count:
        raise NmmError(f"crack tip {tip}: {count} tips: expected a tip of a crack inside a block")
    _check_domain(model.cut, tip, radius)
    tips = model.cut.tips
    point, ahead = tips.point[tip], tips.direction[tip]
    polygons = model.manifold.elements
    near = np.flatnonzero(
        (np.hypot(*(polygons.centroids - point).T) < 2 * radius)
        & (model.manifold.element_body == model.manifold.element_body[tips.element[tip]])
    )
    shear = float(model.elasticity[tips.element[tip], 2, 2])
    fields = _Auxiliary(Enrichment(crack_tip_functions(kappa, 1.0), point, ahead), shear)
    held = model.pressure(unknowns) if pressure is None else pressure
    total = _domain(model, unknowns, near, radius, fields, body_force, held)
    if face_traction is not None:
        total -= _faces(model, radius, fields, face_traction)
    stiff = 8 * shear / (kappa + 1)  # E'
    opening, sliding = (stiff / 2 * total).tolist()
    rate = (opening**2 + sliding**2) / stiff
    return StressIntensity(opening, sliding, rate, point, ahead)


def _check_domain(cut: CutCells, tip: int, radius: float) -> None:
    found = nearest_obstacle(cut, tip)
    if not 0 < radius <= found.distance * (1 + NEAR):
        x, y = cut.tips.point[tip]
        raise NmmError(
            f"crack tip {tip} at [{x:.6g}, {y:.6g}]: radius {radius:.6g}: {found.what} is "
            f"{found.distance:.6g} m away: expected a domain of material about one straight crack: "
            f"use a radius above 0 and up to {found.distance:.6g}, several cells of the cover"
        )


@dataclass(frozen=True)
class _Auxiliary:
    """Fields of unit K_I and K_II."""

    tip: Enrichment
    shear: float

    def gradients(self, points: Floats, side: Floats) -> Floats:
        """Gradients (m, 2, 2 components, 2 directions) of the displacements."""
        unit = 1 / (2 * self.shear * np.sqrt(2 * np.pi))
        return np.asarray(unit * singular_fields(self.tip, points, side)[1])

    def cutoff(self, points: Floats, radius: float) -> tuple[Floats, Floats]:
        """``q`` (m,) and its gradient (m, 2)."""
        away = points - self.tip.point
        r = np.maximum(np.hypot(*away.T), 1e-300)
        s = np.clip((r / radius - INNER) / (1 - INNER), 0.0, 1.0)
        q = 1 - s**3 * (10 - 15 * s + 6 * s**2)
        slope = -30 * s**2 * (1 - s) ** 2 / (radius * (1 - INNER))
        return q, (slope / r)[:, None] * away


def _domain(
    model: Model,
    unknowns: Floats,
    near: Ints,
    radius: float,
    fields: _Auxiliary,
    body_force: Field | None,
    pressure: Floats | None,
) -> Floats:
    point, ahead = fields.tip.point, fields.tip.direction
    polygons = model.manifold.elements.take(near)
    reach = np.hypot(*(polygons.points - point).T)
    size = np.maximum.reduceat(reach, polygons.first_point)
    close = size < 0.5 * radius
    total = np.zeros(2)
    # About the tip fields are singular; further out the cut-off is what is not polynomial.
    for chosen, singular in ((close, True), (~close, False)):
        index = np.flatnonzero(chosen)
        if not len(index):
            continue
        part = polygons.take(index)
        rule = tip_rule(part, point, ORDER) if singular else polygon_rule(part, ORDER)
        owner = near[index][rule.owner]
        q, dq = fields.cutoff(rule.points, radius)
        gradient = _gradients(model, unknowns, owner, rule.points)
        side = _sides(model, owner, fields)
        stress = _held_stress(model, owner, rule.points, gradient, pressure)
        for mode in (0, 1):
            v = fields.gradients(rule.points, side)[:, mode]
            density = _density(model.elasticity[owner], stress, gradient, v, ahead, dq)
            total[mode] += rule.weights @ density
            if body_force is not None:
                work = np.einsum("mi,mij,j->m", body_force(rule.points), v, ahead)
                total[mode] -= rule.weights @ (work * q)
    return total


def _gradients(model: Model, unknowns: Floats, owner: Ints, points: Floats) -> Floats:
    index, rows = model.manifold.gradient_rows(owner, points)
    return np.asarray(np.einsum("mcjl,ml->mcj", rows, unknowns[index]))


def _held_stress(
    model: Model, owner: Ints, points: Floats, gradient: Floats, pressure: Floats | None
) -> Floats:
    """Stress tensors (m, 2, 2) of the displacement, with the pressures on patches."""
    if pressure is None:
        return _stress(model.elasticity[owner], gradient)
    assert model.pressures is not None
    mean = model.pressures.rows(model.manifold, owner, points) @ pressure
    return _stress(model.drained[owner], gradient) + mean[:, None, None] * np.eye(2)


def _density(
    elasticity: Floats, one: Floats, u: Floats, v: Floats, ahead: Floats, dq: Floats
) -> Floats:
    """Integrand without body force; derivatives along ``ahead`` are those by axis 1."""
    two = _stress(elasticity, v)
    u1, v1 = u @ ahead, v @ ahead
    mutual = np.einsum("mij,mij->m", one, v)
    flow = np.einsum("mij,mi,mj->m", one, v1, dq) + np.einsum("mij,mi,mj->m", two, u1, dq)
    return np.asarray(flow - mutual * (dq @ ahead))


def _stress(elasticity: Floats, gradient: Floats) -> Floats:
    """Stress tensors (m, 2, 2) from displacement gradients."""
    shear = gradient[:, 0, 1] + gradient[:, 1, 0]
    strain = np.stack([gradient[:, 0, 0], gradient[:, 1, 1], shear], axis=1)
    return np.asarray(np.einsum("mij,mj->mi", elasticity, strain)[:, [[0, 2], [2, 1]]])


def _sides(model: Model, owner: Ints, fields: _Auxiliary) -> Floats:
    away = model.manifold.elements.centroids[owner] - fields.tip.point
    ahead = fields.tip.direction
    return np.where(ahead[0] * away[:, 1] - ahead[1] * away[:, 0] >= 0, 1.0, -1.0)


def _faces(
    model: Model,
    radius: float,
    fields: _Auxiliary,
    face_traction: Callable[[Floats, Floats], Floats],
) -> Floats:
    """Work of the tractions on the faces within the domain; graded towards the tip."""
    edges = model.cut.boundary
    point, ahead = fields.tip.point, fields.tip.direction
    middle = (edges.start + edges.end) / 2
    found = np.flatnonzero((edges.crack >= 0) & (np.hypot(*(middle - point).T) < 2 * radius))
    start, end = edges.start[found] - point, edges.end[found] - point
    # In u = sqrt(r) the weakly singular integrand is smooth.
    a, b = np.sqrt(np.hypot(*start.T)), np.sqrt(np.hypot(*end.T))
    nodes, weights = segment_rule(np.zeros((1, 2)), np.array([[1.0, 0.0]]), ORDER)
    t, w = nodes[0, :, 0], weights[0]
    u = a[:, None] + (b - a)[:, None] * t
    share = (u**2 - a[:, None] ** 2) / (b**2 - a**2)[:, None]
    points = point + start[:, None] + share[..., None] * (end - start)[:, None]
    length = np.hypot(*(end - start).T)
    scale = length[:, None] * 2 * u * (b - a)[:, None] / (b**2 - a**2)[:, None] * w
    flat = points.reshape(-1, 2)
    owner = np.repeat(edges.element[found], len(t))
    along = (end - start) / length[:, None]
    normal = np.repeat(np.stack([along[:, 1], -along[:, 0]], 1), len(t), axis=0)
    pull = face_traction(flat, normal)
    q, _ = fields.cutoff(flat, radius)
    v = fields.gradients(flat, _sides(model, owner, fields))
    work = np.einsum("mi,mnij,j->mn", pull, v, ahead) * q[:, None]
    return np.asarray(scale.ravel() @ work)
