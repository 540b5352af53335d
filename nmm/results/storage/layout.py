"""What arrays a frame and a topology are made of: their kinds and shapes, checked at reading."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Bools
from nmm.quantity import APART

Arrays = Mapping[str, npt.NDArray[Any]]

# Kind of numpy (float, integer, text), and the shape: letters are lengths that must agree.
_FRAME: dict[str, tuple[str, tuple[str | int, ...]]] = {
    "index": ("i", ()),
    "time": ("f", ()),
    "load_factor": ("f", ()),
    "stage": ("U", ()),
    "points": ("f", ("points", 2)),
    "displacement": ("f", ("points", 2)),
    "velocity": ("f", ("points", 2)),
    "stress": ("f", ("elements", 3)),
    "contact_position": ("f", ("contacts", 2)),
    "contact_normal": ("f", ("contacts", 2)),
    "contact_length": ("f", ("contacts",)),
    "contact_force": ("f", ("contacts", 2)),
    "contact_gap": ("f", ("contacts",)),
    "contact_state": ("i", ("contacts",)),
    "topology": ("i", ()),
}
_TOPOLOGY: dict[str, tuple[str, tuple[str | int, ...]]] = {
    "points": ("f", ("points", 2)),
    "ring_offsets": ("i", ("rings",)),
    "polygon_offsets": ("i", ("polygons",)),
    "element_region": ("i", ("elements",)),
    "region_material": ("i", ("regions",)),
    "material_names": ("U", ("materials",)),
    "region_names": ("U", ("names",)),
}


FIELDS = ("field_names", "field_places", "field_units", "field_components")
"""Texts (F,) of the further quantities of a frame, whose values are `field_0`, `field_1`, ..."""


def frame_misfit(arrays: Arrays) -> str | None:
    """Return what is wrong with the arrays of a frame, None when they fit together."""
    wrong, lengths = _misfit(arrays, _FRAME)
    if wrong is not None or FIELDS[0] not in arrays:
        return wrong
    wrong, counts = _misfit(arrays, dict.fromkeys(FIELDS, ("U", ("fields",))))
    if wrong is not None:
        return wrong
    places = arrays["field_places"].tolist()
    for number in range(counts["fields"]):  # a handful of quantities
        values = arrays.get(f"field_{number}")
        if values is None or values.dtype.kind != "f" or values.ndim not in (1, 2):
            return f"its field_{number} is no array of numbers"
        if places[number] in APART:
            lengths.setdefault(places[number], len(values))
        if lengths.get(places[number]) != len(values):
            return f"its field_{number} does not fit its {places[number]}"
    return None


def topology_misfit(arrays: Arrays) -> str | None:
    """Return what is wrong with the arrays of a topology, None when they fit together."""
    wrong, lengths = _misfit(arrays, _TOPOLOGY)
    if wrong is not None:
        return wrong
    rings, polygons = arrays["ring_offsets"], arrays["polygon_offsets"]
    if not _counts(rings, 3, lengths["points"]) or not _counts(polygons, 1, len(rings) - 1):
        return "its polygons do not fit their points"
    region, material = arrays["element_region"], arrays["region_material"]
    if len(region) != len(polygons) - 1 or not _within(region, lengths["regions"]):
        return "its elements do not fit their regions"
    if not _within(material, lengths["materials"]):
        return "its regions do not fit their materials"
    if lengths["names"] not in (0, lengths["regions"]):
        return "its regions do not fit their names"
    return None


def _misfit(
    arrays: Arrays, expected: Mapping[str, tuple[str, tuple[str | int, ...]]]
) -> tuple[str | None, dict[str, int]]:
    lengths: dict[str, int] = {}
    for name, (kind, shape) in expected.items():
        array = arrays[name]
        if array.dtype.kind != kind or array.ndim != len(shape):
            return f"its {name} are {array.ndim}-dimensional, of type {array.dtype}", lengths
        for wanted, found in zip(shape, array.shape, strict=True):
            known = wanted if isinstance(wanted, int) else lengths.setdefault(wanted, found)
            if found != known:
                return f"its {name} have the shape {array.shape}", lengths
    return None, lengths


def _counts(offsets: npt.NDArray[Any], least: int, end: int) -> bool:
    """Whether offsets rise from 0 to the end, by no less than so many."""
    ends = len(offsets) > 0 and offsets[0] == 0 and offsets[-1] == end
    return bool(ends and np.all(np.diff(offsets) >= least))


def _within(indices: npt.NDArray[Any], count: int) -> bool:
    inside: Bools = (indices >= 0) & (indices < count)
    return bool(inside.all())
