"""Blocks and joints from files: WKT and GeoJSON; DXF by ezdxf and Gmsh meshes by meshio.

An import is turned into `[[blocks]]` of a scene file, so that the scene stays complete by itself:

>>> drawing = read_drawing("slope.dxf", scale=1e-3)            # doctest: +SKIP
>>> print(toml_blocks(drawing, material="rock"))               # doctest: +SKIP
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import shapely

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.errors import Fault, GeometryError
from nmm.geometry.tessellation.faces import faces

_LINES = (shapely.GeometryType.LINESTRING, shapely.GeometryType.LINEARRING)
_Entry = tuple[Any, str]  # geometry, layer


@dataclass(frozen=True)
class Drawing:
    """What a file holds.

    Attributes
    ----------
    polygons
        Closed outlines, N of them.
    layer
        Layer, property "name" or physical group of each polygon; "" if there is none.
    lines : (m, 2, 2)
        Segments of open lines: joint traces, or outlines drawn edge by edge.
    """

    polygons: Polygons
    layer: tuple[str, ...]
    lines: Floats

    def enclosed(self) -> Polygons:
        """Faces that the open lines enclose, for drawings made of single lines."""
        return Polygons.from_shapely(
            faces(np.array(shapely.linestrings(self.lines), dtype=object))
        ).oriented()


def read_drawing(path: str | Path, scale: float = 1.0) -> Drawing:
    """Polygons and lines of a .wkt, .geojson, .json, .dxf or .msh file.

    Parameters
    ----------
    path
        The file; its ending names its format.
    scale
        Metres per unit of the file, 1e-3 for a drawing in mm.

    Raises
    ------
    GeometryError
        The file is missing, has another format, or holds no geometry; or ezdxf or meshio is not
        installed.
    """
    path = Path(path)
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        formats = ", ".join(_READERS)
        raise _error(path, f'ending "{path.suffix}"', f"one of {formats}", "convert the file")
    if not path.is_file():
        raise _error(path, "no such file", "a file", "check the path")
    try:
        entries = reader(path)
    except GeometryError:
        raise
    except Exception as cause:  # each library has errors of its own for malformed files
        reason = " ".join(str(cause).split())[:120]
        raise _error(path, reason, f"a {path.suffix} file", "check the file") from cause
    return _drawing(entries, path, scale)


def toml_blocks(drawing: Drawing, material: str) -> str:
    """Polygons of a drawing as `[[blocks]]` of a scene file."""
    return "\n".join(
        f"[[blocks]]\nmaterial = {json.dumps(material)}\n{_toml_rings(polygon)}"
        for polygon in drawing.polygons.to_shapely()
    )


def _toml_rings(polygon: shapely.Polygon) -> str:
    def ring(line: Any) -> str:
        return json.dumps(shapely.get_coordinates(line)[:-1].tolist())

    holes = ", ".join(ring(hole) for hole in polygon.interiors)
    return f"vertices = {ring(polygon.exterior)}\n" + (f"holes = [{holes}]\n" if holes else "")


def _drawing(entries: Sequence[_Entry], path: Path, scale: float) -> Drawing:
    parts = [(part, layer) for shape, layer in entries for part in shapely.get_parts(shape)]
    kinds = shapely.get_type_id(np.array([part for part, _ in parts], dtype=object))
    solids = [parts[k] for k in np.flatnonzero(kinds == shapely.GeometryType.POLYGON)]
    is_line = (kinds == shapely.GeometryType.LINESTRING) | (
        kinds == shapely.GeometryType.LINEARRING
    )
    lines = [parts[k][0] for k in np.flatnonzero(is_line)]
    if not solids and not lines:
        raise _error(path, "no polygon and no line", "some geometry", "check the file")
    shapes = np.array([shapely.force_2d(shape) for shape, _ in solids], dtype=object)
    polygons = Polygons.from_shapely(shapes)
    points, line = shapely.get_coordinates(np.array(lines, dtype=object), return_index=True)
    follows = np.flatnonzero(line[1:] == line[:-1])
    segments = scale * np.stack([points[follows], points[follows + 1]], axis=1)
    scaled = polygons.with_points(scale * polygons.points).oriented()
    return Drawing(scaled, tuple(layer for _, layer in solids), segments.reshape(-1, 2, 2))


def _wkt(path: Path) -> list[_Entry]:
    lines = (line.strip() for line in path.read_text(encoding="utf-8").splitlines())
    return [(shapely.from_wkt(line), "") for line in lines if line]


def _geojson(path: Path) -> list[_Entry]:
    data = json.loads(path.read_text(encoding="utf-8"))
    features = data.get("features", [data])
    return [
        (
            shapely.from_geojson(json.dumps(item.get("geometry", item))),
            str((item.get("properties") or {}).get("name", "")),
        )
        for item in features
    ]


def _dxf(path: Path) -> list[_Entry]:
    entities = _extra("ezdxf", path).readfile(path).modelspace()
    return [
        *((_dxf_line(item), item.dxf.layer) for item in entities.query("LINE")),
        *((_dxf_polyline(item, path), item.dxf.layer) for item in entities.query("LWPOLYLINE")),
    ]


def _dxf_line(entity: Any) -> Any:
    start, end = entity.dxf.start, entity.dxf.end
    return shapely.LineString([(start.x, start.y), (end.x, end.y)])


def _dxf_polyline(entity: Any, path: Path) -> Any:
    if entity.has_arc:
        value = f"arcs in a polyline of layer {entity.dxf.layer}"
        raise _error(path, value, "straight edges", "turn arcs into segments in the CAD program")
    points = [(x, y) for x, y in entity.vertices()]
    return shapely.Polygon(points) if entity.is_closed else shapely.LineString(points)


def _msh(path: Path) -> list[_Entry]:
    meshio = _extra("meshio", path)
    mesh = meshio.read(path)
    names = {int(tag): name for name, (tag, kind) in mesh.field_data.items() if kind == 2}
    entries: list[_Entry] = []
    for number, block in enumerate(mesh.cells):  # a handful of kinds of cells
        if block.type not in ("triangle", "quad"):
            continue
        tags = mesh.cell_data.get("gmsh:physical", [])
        layers = [names.get(int(tag), str(tag)) for tag in tags[number]] if tags else []
        shapes = shapely.polygons(mesh.points[block.data][:, :, :2])
        entries += zip(shapes, layers or [""] * len(shapes), strict=True)
    return entries


_READERS: dict[str, Callable[[Path], list[_Entry]]] = {
    ".wkt": _wkt,
    ".geojson": _geojson,
    ".json": _geojson,
    ".dxf": _dxf,
    ".msh": _msh,
}


def _extra(name: str, path: Path) -> ModuleType:
    from importlib import import_module

    try:
        return import_module(name)
    except ImportError:
        remedy = f"pip install {name}"
        raise _error(path, f"{name} is not installed", f"{name}", remedy) from None


def _error(path: Path, value: str, expected: str, remedy: str) -> GeometryError:
    return GeometryError(Fault(str(path), value, expected, remedy))
