"""Stress intensity factors of cracks by the interaction integral in its domain form.

With the auxiliary fields of unit K_I and K_II (Williams 1957), a weight ``q`` that is 1 near the
tip and 0 at the radius of the domain, and axes 1 ahead of the crack and 2 across it (Yau, Wang and
Corten 1980; Moran and Shih 1987; Shih and Asaro 1988)

    I = int (s_ij v_i,1 + r_ij u_i,1 - s_mn e(v)_mn delta_1j) q_,j - b_i v_i,1 q  dA
        - int_faces (t_i v_i,1 + r_ij m_j u_i,1 - s_mn e(v)_mn m_1) q  ds,     K = E' I / 2,

where ``s`` is the stress and ``b`` the body force of the displacement ``u``, ``r`` the stress of
the auxiliary displacement ``v``, ``t`` the traction on the faces and ``m`` their outward normal.
On a kinked or curved crack the angle of ``v`` is taken to jump across the crack itself, so that
``v`` leaves tractions on its faces, for which the last two terms account; straight behind the tip
they vanish. So a domain may contain kinks, other cracks with their tips and parts of the boundary,
but not the whole of its own crack. In motion, density times acceleration is subtracted from ``b``.
"""

from dataclasses import dataclass

from covers.cutting.cut_cells import CutCells
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.errors import NmmError
from nmm.fracture.intensity_rows import IntensityRows
from nmm.fracture.interaction import Field, Traction
from nmm.fracture.surroundings import farthest_face

# Relative tolerance of the largest radius.
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
        (2,) place of the tip (m), and the unit vector ahead of it.
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
    face_traction: Traction | None = None,
    pressure: Floats | None = None,
    acceleration: Floats | None = None,
) -> StressIntensity:
    """Return the stress intensity factors at a tip of the model's cracks.

    Parameters
    ----------
    model, unknowns
        A model on a cut mesh and its displacements.
    tip
        Its number among ``model.cut.tips``.
    radius
        Radius of the domain (m), up to the far end of the crack; best clear of the boundary and of
        other cracks.
    kappa
        Kolosov's constant (`nmm.materials.base.Law.kolosov`).
    body_force, face_traction
        Body force (N/m3) as a function of points, and traction (Pa) as a function of points and
        outward normals; None for none.
    pressure
        (k,) projected pressures (Pa), see `nmm.assembly.errors.stresses`.
    acceleration
        (n,) accelerations of the unknowns, in motion.

    Raises
    ------
    NmmError
        The tip does not exist, or the domain contains the whole crack, about which no angle is
        continuous.
    """
    count = len(model.cut.tips)
    if not 0 <= tip < count:
        raise NmmError(f"crack tip {tip}: {count} tips: expected a tip of a crack inside a block")
    check_domain(model.cut, tip, radius)
    rows = IntensityRows.of(model, tip, radius, kappa, face_traction)
    held = model.pressure(unknowns) if pressure is None else pressure
    found = rows.intensities(unknowns, held)
    if body_force is not None:
        found = found + rows.of_forces(body_force)
    if acceleration is not None:
        found = found + rows.of_acceleration(acceleration)
    opening, sliding = found.tolist()
    rate = (opening**2 + sliding**2) / rows.stiff
    return StressIntensity(
        opening, sliding, rate, model.cut.tips.point[tip], model.cut.tips.direction[tip]
    )


def check_domain(cut: CutCells, tip: int, radius: float) -> None:
    """Refuse a domain that contains the whole of its crack.

    Raises
    ------
    NmmError
        See `stress_intensity`.
    """
    away = farthest_face(cut, tip)
    if not 0 < radius <= away * (1 + NEAR):
        x, y = cut.tips.point[tip]
        raise NmmError(
            f"crack tip {tip} at [{x:.6g}, {y:.6g}]: radius {radius:.6g}: the crack reaches "
            f"{away:.6g} m from it: expected a domain that does not hold all of it: use a radius "
            f"above 0 and up to {away:.6g}, several cells of the cover"
        )
