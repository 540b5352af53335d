"""Blocks and joints from files."""

import json
from pathlib import Path

import numpy as np
import pytest

from nmm.errors import GeometryError
from nmm.geometry import regions
from nmm.geometry.imports import read_drawing, toml_blocks
from nmm.scene import parse_scene

SQUARE = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]


def test_well_known_text_gives_polygons_and_joints(tmp_path: Path) -> None:
    path = tmp_path / "a.wkt"
    path.write_text(
        "POLYGON ((0 0, 0 1, 2 1, 2 0, 0 0), (0.5 0.5, 1 0.5, 1 0.6, 0.5 0.5))\n\n"
        "MULTILINESTRING ((0 0, 1 1, 2 0), (3 3, 4 4))\n"
    )
    drawing = read_drawing(path)
    assert drawing.polygons.areas == pytest.approx([2 - 0.025])
    assert drawing.lines.shape == (3, 2, 2)


def test_geojson_features_keep_their_names(tmp_path: Path) -> None:
    path = tmp_path / "a.geojson"
    shape = {"type": "Polygon", "coordinates": [[*SQUARE, SQUARE[0]]]}
    feature = {"type": "Feature", "properties": {"name": "toe"}, "geometry": shape}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    drawing = read_drawing(path, scale=1e-3)
    assert drawing.layer == ("toe",)
    assert drawing.polygons.areas == pytest.approx([2e-6])
    path.write_text(json.dumps(shape))
    assert read_drawing(path).layer == ("",)


def test_a_drawing_becomes_blocks_of_a_scene_without_loss(tmp_path: Path) -> None:
    path = tmp_path / "a.wkt"
    path.write_text(
        "POLYGON ((0 0, 0.1 0, 0.3 0.7, 0 0), (0.11 0.1, 0.12 0.1, 0.12 0.15, 0.11 0.1))"
    )
    drawing = read_drawing(path)
    head = 'plane = "strain"\n[materials.rock]\nyoung_modulus = 1e9\npoisson_ratio = 0.2\n'
    whole = regions(parse_scene(head + toml_blocks(drawing, "rock")))
    assert whole.polygons.points.tolist() == drawing.polygons.points.tolist()
    assert whole.polygons.areas == pytest.approx(drawing.polygons.areas, rel=1e-14)


def test_dxf_outlines_and_lines_are_read_by_layer(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new()
    space = document.modelspace()
    space.add_lwpolyline(SQUARE, close=True, dxfattribs={"layer": "blocks"})
    for start, end in zip(SQUARE, SQUARE[1:] + SQUARE[:1], strict=True):
        space.add_line(np.add(start, 5), np.add(end, 5), dxfattribs={"layer": "joints"})
    path = tmp_path / "a.dxf"
    document.saveas(path)
    drawing = read_drawing(path)
    assert drawing.layer == ("blocks",)
    assert drawing.polygons.areas.tolist() == [2.0]
    assert drawing.enclosed().areas.tolist() == [2.0]


def test_arcs_in_a_dxf_outline_are_refused(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new()
    document.modelspace().add_lwpolyline([(0, 0, 0, 0, 1), (1, 0), (1, 1)], close=True)
    path = tmp_path / "a.dxf"
    document.saveas(path)
    with pytest.raises(GeometryError, match="arcs"):
        read_drawing(path)


def test_gmsh_cells_become_polygons_with_their_groups(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0]], dtype=float)
    cells = [("triangle", np.array([[1, 4, 2]])), ("quad", np.array([[0, 1, 2, 3]]))]
    tags = [np.array([7]), np.array([8])]
    mesh = meshio.Mesh(
        points,
        cells,
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data={"rock": np.array([7, 2])},
    )
    path = tmp_path / "a.msh"
    meshio.write(path, mesh, file_format="gmsh22", binary=False)
    drawing = read_drawing(path)
    assert drawing.polygons.areas.tolist() == [0.5, 1.0]
    assert drawing.layer == ("rock", "8")


@pytest.mark.parametrize(
    ("name", "text", "part"),
    [
        ("a.stl", "", 'ending ".stl"'),
        ("a.wkt", "POLYGON ((0 0, 1", "check the file"),
        ("a.wkt", "POINT (1 1)", "no polygon and no line"),
        ("a.json", "{", "check the file"),
        ("a.dxf", "nonsense", "check the file"),
    ],
)
def test_an_unreadable_file_is_named(tmp_path: Path, name: str, text: str, part: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(GeometryError, match=part) as caught:
        read_drawing(tmp_path / name)
    assert str(tmp_path) in str(caught.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(GeometryError, match="no such file"):
        read_drawing(tmp_path / "none.wkt")
