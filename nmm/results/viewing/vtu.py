"""One VTK unstructured grid as XML text, its arrays in base64 (VTK file formats, XML, version 1.0).

XDMF would be smaller but crashes some versions of ParaView; .vtu is read by all of them.
"""

import base64
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints

VERTEX, LINE, TRIANGLE, POLYGON = 1, 3, 5, 7

_TYPES = {"f8": "Float64", "i8": "Int64", "u1": "UInt8"}


def unstructured_grid(
    points: Floats,
    connectivity: Ints,
    offsets: Ints,
    types: npt.NDArray[np.uint8],
    point_data: Mapping[str, npt.NDArray[Any]],
    cell_data: Mapping[str, npt.NDArray[Any]],
    components: Mapping[str, Sequence[str]],
) -> str:
    """Return the text of a .vtu file.

    Parameters
    ----------
    points
        (P, 2) or (P, 3) coordinates, m.
    connectivity, offsets, types
        Point indices of all cells, their (n,) ends and their (n,) VTK cell types.
    point_data, cell_data
        Arrays by name, one row a point or a cell.
    components
        Names of the components of arrays that are neither scalars nor vectors in space.
    """
    parts = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
        'header_type="UInt64">',
        "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(offsets)}">',
        "<Points>",
        _array("Points", in_space(points)),
        "</Points>",
        "<Cells>",
        _array("connectivity", connectivity),
        _array("offsets", offsets),
        _array("types", types),
        "</Cells>",
        "<PointData>",
        *(_array(name, values, components.get(name, ())) for name, values in point_data.items()),
        "</PointData>",
        "<CellData>",
        *(_array(name, values, components.get(name, ())) for name, values in cell_data.items()),
        "</CellData>",
        "</Piece>",
        "</UnstructuredGrid>",
        "</VTKFile>",
    ]
    return "\n".join(parts) + "\n"


def collection(times: Sequence[float], names: Sequence[str]) -> str:
    """Return the text of a .pvd file that puts files at times, s."""
    entries = (
        f'<DataSet timestep="{time!r}" part="0" file="{name}"/>'
        for time, name in zip(times, names, strict=True)
    )
    return "\n".join(
        [
            '<?xml version="1.0"?>',
            '<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">',
            "<Collection>",
            *entries,
            "</Collection>",
            "</VTKFile>",
            "",
        ]
    )


def in_space(vectors: Floats) -> Floats:
    """(n, 3) vectors of (n, 2) ones: a zero third component, as viewers expect."""
    return np.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1])))


def _array(name: str, values: npt.NDArray[Any], components: Sequence[str] = ()) -> str:
    kind = values.dtype.str[1:]
    content = np.ascontiguousarray(values, dtype=f"<{kind}").tobytes()
    width = values.shape[1] if values.ndim == 2 else 1
    named = "".join(f' ComponentName{i}="{text}"' for i, text in enumerate(components))
    coded = base64.b64encode(np.array([len(content)], dtype="<u8").tobytes() + content).decode()
    return (
        f'<DataArray type="{_TYPES[kind]}" Name="{name}" NumberOfComponents="{width}"{named} '
        f'format="binary">{coded}</DataArray>'
    )
