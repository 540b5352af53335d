"""The parts of contact, as a scene and its formulation declare them."""

from collections.abc import Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Bools, Floats, Ints
from nmm.contact.bonds.consistent_bonds import consistent
from nmm.contact.candidates.pairs import MISSING, Pairs
from nmm.contact.candidates.partners import Partners
from nmm.contact.enforcement.base import make_enforcement
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.mortar.segments import face_points
from nmm.contact.mortar.trace_space import TraceSpace
from nmm.contact.parts import ContactParts
from nmm.contact.points.cracks.bonded_cracks import BondedCracks
from nmm.effects.acted.acted_bonds import acted_on
from nmm.effects.base import Setup
from nmm.errors import Fault, FormulationError, SceneError
from nmm.formulation import ContactMethod
from nmm.geometry.tessellation.cover_types import piece_glue
from nmm.integrators.base import make_integrator
from nmm.interfaces.from_scene import interface_law

if TYPE_CHECKING:
    from nmm.contact.laws.laid_under_stress import StressIn
    from nmm.scene.actions import SupportTable

# Distance, in tolerances of the cut, within which an edge lies on a crack.
MOVED = 4.0
# Largest number of Gauss points of a joint on splines and moving least squares.
MOST_POINTS = 4


def contact_parts(setup: Setup) -> ContactParts:
    """Read ``[contact]``, the interfaces, and ``[contact]`` of the formulation."""
    method, manifold = setup.formulation.contact, setup.model.manifold
    given = {"max_passes": method.max_passes} if "max_passes" in method.model_fields_set else {}
    enforcement = make_enforcement(method.enforcement, dict(method.options), given)
    springs = _conserves(setup) and not enforcement.exact
    laws, points = _laws(setup), face_points(manifold, method.points, springs)
    # Means are for shared covers with rigid laws: blocks need no means, and a mean has no
    # stiffness.
    means = enforcement.multipliers and manifold.shared_covers and points > 0 and not laws.stiff
    partners = Partners(
        setup.model,
        _pairs(setup),
        within_bodies=bool(setup.geometry.cracks) or setup.kinematics.finite,
        face_points=points,
        origin=setup.origin,
        whole_faces=means,
        together=_together(setup),
        weight=_weight(setup),
    )
    edges, modulus = setup.model.cut.boundary, setup.model.modulus
    nodes = TraceSpace.of(partners.sides, edges, modulus, partners.welded) if means else None
    joint_rule, cracks = _joint_rule(method, laws, manifold), _cracks(setup)
    held, bends = _held(setup), points > 2
    mixed = setup.scene.inertia is None and not enforcement.exact
    if springs and points:
        raise _no_potential(setup)
    parts = laws, partners, enforcement, joint_rule, cracks, mixed, held, bends, nodes, springs
    return ContactParts(*parts, partial(acted_on, setup) if laws.consistent else None)


def stress_of_ground(setup: Setup) -> "StressIn | None":
    """Return the initial stress as a function of elements and points; None without any."""
    if not setup.scene.initial_stresses:
        return None
    from nmm.effects.initial.stress_at_start import StressAtStart

    return StressAtStart.declared(setup).within(setup.model)


def _no_potential(setup: Setup) -> FormulationError:
    """Return the error of springs over faces in a scheme that conserves energy.

    Their stiffness changes as bodies slide, so that they have no potential.
    """
    place = setup.formulation.source.place("contact", "points")
    expected = '"vertices" or "auto" under an integrator that keeps energy'
    remedy = "springs over stretches of faces make or lose it as bodies slide, those at corners not"
    return FormulationError(Fault(place, '"faces"', expected, remedy))


def _conserves(setup: Setup) -> bool:
    """Whether the integrator conserves elastic energy."""
    moves = setup.scene.inertia is not None
    return moves and make_integrator(setup.formulation.integrator).conserves


def _cracks(setup: Setup) -> BondedCracks:
    """Return the cracks whose faces are bonded at first."""
    geometry = setup.geometry
    others = geometry.free if geometry.bonded else ()
    return BondedCracks(geometry.bonded_cracks, others, MOVED * setup.model.cut.crack_tolerance)


def _joint_rule(method: ContactMethod, laws: ContactLaws, manifold: Manifold) -> tuple[str, int]:
    """Return the rule of joints along an edge, and its number of Gauss points.

    Forces at the corners of an edge strain higher-order fields locally: by 0.6 of a cell's own
    strain with covers of degree 1, by the whole of it with degree 2; forces at Gauss points do not.
    Separate bodies need as many points as their degree asks; cells of shared covers hold each
    other, and need fewer.
    """
    auto = "gauss" if laws.consistent or manifold.degree > 1 else "corners"
    degree = manifold.degree
    count = min(max(2, degree), MOST_POINTS) if manifold.shared_covers else max(2, degree + 1)
    return auto if method.joint_points == "auto" else method.joint_points, count


def _laws(setup: Setup) -> ContactLaws:
    """Return the interface laws, with penalties in multiples of the largest modulus."""
    method, thickness = setup.formulation.contact, setup.model.thickness
    unit = float(setup.model.modulus.max()) * thickness
    penalty, bond = method.normal_penalty * unit, method.bond_stiffness * unit
    laws = [interface_law(item) for item in setup.scene.interfaces.values()]
    glued = any(law.bonded and law.normal_stiffness is None for law in laws)
    return ContactLaws(
        laws=laws,
        thickness=thickness,
        normal_penalty=penalty,
        shear_penalty=penalty * method.shear_ratio,
        normal_bond=bond,
        shear_bond=bond * method.shear_ratio,
        consistent=glued and consistent(setup.model, method.bonds),
        names=tuple(setup.scene.interfaces),
    )


def _pairs(setup: Setup) -> Pairs:
    """Return the interface of each pair of materials of a scene."""
    materials = list(setup.scene.materials)
    names: Mapping[int, str] = dict(enumerate(materials))
    order = {id(item): number for number, item in enumerate(setup.scene.interfaces.values())}
    table = np.full((len(materials), len(materials)), MISSING)
    for i, j in np.ndindex(*table.shape):  # pairs of materials
        try:
            table[i, j] = order[id(setup.scene.interface(names[i], names[j]))]
        except SceneError:
            continue
    glued = piece_glue(setup.formulation.cover) is not None
    return Pairs(table, setup.region_material, glued)


def _held(setup: Setup) -> Bools:
    """Which bodies (B,) are fixed as a whole by a support."""
    held: Bools = np.zeros(setup.model.manifold.n_bodies, dtype=bool)
    for _, bodies in _holding(setup):  # a handful of supports
        held[bodies] = True
    return held


def _together(setup: Setup) -> Ints:
    """Return numbers (B,) that bodies share which cannot move apart.

    They are glued pieces of one block, and bodies that supports hold, or move alike.
    """
    manifold = setup.model.manifold
    number = np.arange(manifold.n_bodies)
    if piece_glue(setup.formulation.cover) is not None:
        number[manifold.element_body] = manifold.element_region
    ways: list[object] = []
    for support, bodies in _holding(setup):  # a handful of supports
        if support.field is None:
            way = support.displacement, support.motion
            if way not in ways:
                ways.append(way)
            number[bodies] = -1 - ways.index(way)
    return number


def _weight(setup: Setup) -> Floats | None:
    """Return the acceleration (B, 2) that weight gives bodies which no support holds (m/s2)."""
    gravity = setup.scene.gravity
    if gravity is None:
        return None
    return np.where(_held(setup)[:, None], 0.0, np.array(gravity.acceleration))


def _holding(setup: Setup) -> Iterator[tuple["SupportTable", Ints]]:
    """Yield the supports that fix bodies as a whole, and these bodies, one for each element."""
    manifold = setup.model.manifold
    for support in setup.scene.supports:  # a handful of supports
        if support.point is None and support.segment is None and len(set(support.fix)) == 2:
            regions = setup.regions(support.block)
            inside = slice(None) if regions is None else regions[manifold.element_region]
            yield support, manifold.element_body[inside]
