"""A frame as .vtu texts: its elements, contact points, members and cracks, and crack tips."""

from collections.abc import Mapping

import numpy as np

from integration.arrays import Floats
from integration.plane_vectors import clockwise
from nmm.quantity import ENDS, SPOT, Quantity
from nmm.results.frame import Frame, Topology
from nmm.results.viewing.cells import PolygonCells
from nmm.results.viewing.vtu import LINE, POLYGON, TRIANGLE, VERTEX, in_space, unstructured_grid

STRESS: dict[str, tuple[str, ...]] = {"stress": ("xx", "yy", "xy")}


def blocks_grid(frame: Frame, topology: Topology, cut: PolygonCells) -> str:
    """Return the .vtu text of the elements of a frame."""
    sizes = np.diff(cut.offsets, prepend=0)
    return unstructured_grid(
        points=frame.points - frame.displacement,
        connectivity=cut.connectivity,
        offsets=cut.offsets,
        types=np.where(sizes == 3, TRIANGLE, POLYGON).astype(np.uint8),
        point_data={
            "displacement": in_space(frame.displacement),
            "velocity": in_space(frame.velocity),
            **{name: _shown(one.values) for name, one in frame.on("points").items()},
        },
        cell_data={
            "stress": frame.stress[cut.polygon],
            "block": topology.element_region[cut.polygon],
            "material": topology.element_material[cut.polygon],
            **{n: _shown(q.values)[cut.polygon] for n, q in frame.on("elements").items()},
        },
        components=STRESS | _components(frame),
    )


def contacts_grid(frame: Frame) -> str:
    """Return the .vtu text of the contact points of a frame.

    `force` is the force on side b, N n + T t with the normal n from side b to side a, t a quarter
    turn clockwise from it, and N positive in tension.
    """
    number = np.arange(len(frame.contact_gap))
    return unstructured_grid(
        points=frame.contact_position,
        connectivity=number,
        offsets=number + 1,
        types=np.full(len(number), VERTEX, dtype=np.uint8),
        point_data={
            "force": in_space(contact_vectors(frame)),
            "normal_force": frame.contact_force[:, 0],
            "shear_force": frame.contact_force[:, 1],
            "gap": frame.contact_gap,
            "state": frame.contact_state,
            **{name: _shown(one.values) for name, one in frame.on("contacts").items()},
        },
        cell_data={},
        components=_components(frame),
    )


def segments_grid(frame: Frame, place: str) -> str:
    """Return the .vtu text of the members of a frame, or of its cracks: a line a segment."""
    known = frame.on(place)
    ends = placed(frame, place, ENDS).reshape(-1, 2)
    number = np.arange(len(ends) // 2)
    return unstructured_grid(
        points=ends,
        connectivity=np.arange(len(ends)),
        offsets=2 * (number + 1),
        types=np.full(len(number), LINE, dtype=np.uint8),
        point_data={},
        cell_data=_carried(known, ENDS),
        components={},
    )


def tips_grid(frame: Frame) -> str:
    """Return the .vtu text of the crack tips of a frame."""
    points = placed(frame, "tips", SPOT)
    number = np.arange(len(points))
    return unstructured_grid(
        points=points,
        connectivity=number,
        offsets=number + 1,
        types=np.full(len(number), VERTEX, dtype=np.uint8),
        point_data=_carried(frame.on("tips"), SPOT),
        cell_data={},
        components={},
    )


def placed(frame: Frame, place: str, components: tuple[str, ...]) -> Floats:
    """Return where the segments (`ENDS`) or points (`SPOT`) of a place are, m, a row each."""
    found = [one.values for one in frame.on(place).values() if one.components == components]
    return found[0] if found else np.zeros((0, len(components)))


def _carried(known: Mapping[str, Quantity], where: tuple[str, ...]) -> dict[str, Floats]:
    """Return what segments or points carry, by its name without that of the effect."""
    return {
        name.partition(":")[2]: one.values for name, one in known.items() if one.components != where
    }


def _shown(values: Floats) -> Floats:
    """Return values as viewers expect them: pairs without names are vectors in space."""
    return in_space(values) if values.ndim == 2 and values.shape[1] == 2 else values


def _components(frame: Frame) -> dict[str, tuple[str, ...]]:
    """Return the names of components of the further quantities that have some."""
    return {name: one.components for name, one in frame.fields.items() if one.components}


def contact_vectors(frame: Frame) -> Floats:
    """(C, 2) force on side b at each contact point, N."""
    normal = frame.contact_normal
    tangent = clockwise(normal)
    force: Floats = frame.contact_force[:, :1] * normal + frame.contact_force[:, 1:] * tangent
    return force
