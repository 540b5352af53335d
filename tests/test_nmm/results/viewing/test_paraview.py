"""ParaView files: what VTK itself reads back, or the XML where VTK is not installed."""

import base64
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from integration.polygons import Polygons
from nmm.results import MemorySink, Topology
from nmm.results.viewing.cells import cells, drawable
from nmm.results.viewing.grids import blocks_grid, contact_vectors
from nmm.results.viewing.paraview import output_times, write_paraview

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]]
HOLE = [[1, 1], [1, 3], [3, 3], [3, 1]]
ANGLE = [[5, 0], [8, 0], [8, 1], [6, 1], [6, 3], [5, 3]]
SHAPES = Polygons.from_rings([[SQUARE, HOLE], [ANGLE], [[[9, 0], [10, 0], [10, 2], [9, 1]]]])


def parsed(path):
    """Arrays of a .vtu by section and name, by the XML alone."""
    found = {}
    for section in ("Points", "Cells", "PointData", "CellData"):
        for array in ElementTree.parse(path).iter(section):
            for item in array.iter("DataArray"):
                raw = base64.b64decode(item.text)
                assert np.frombuffer(raw[:8], "<u8")[0] == len(raw) - 8
                kind = {"Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}[item.get("type")]
                width = int(item.get("NumberOfComponents"))
                values = np.frombuffer(raw[8:], kind)
                found[section, item.get("Name")] = (
                    values.reshape(-1, width) if width > 1 else values
                )
    return found


def read_by_vtk(path):
    reading = pytest.importorskip("vtkmodules.vtkIOXML")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    reader = reading.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput(), vtk_to_numpy


def areas_by_vtk(grid, to_numpy):
    measuring = pytest.importorskip("vtkmodules.vtkFiltersVerdict")
    measure = measuring.vtkCellSizeFilter()
    measure.SetInputData(grid)
    measure.Update()
    return to_numpy(measure.GetOutput().GetCellData().GetArray("Area"))


def area_of(points, cut, polygon):
    """Area of the cells of one polygon, by the shoelace formula (Gauss)."""
    start = np.concatenate([[0], cut.offsets[:-1]])
    total = 0.0
    for n in np.flatnonzero(cut.polygon == polygon):
        x, y = points[cut.connectivity[start[n] : cut.offsets[n]]].T
        total += abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    return total


def test_cells_cover_each_polygon_once():
    cut = cells(SHAPES)
    assert list(drawable(SHAPES)) == [False, False, True]
    # 16 - 4, 3 + 2 and a trapezium of mean height 1.5, by hand
    assert [area_of(SHAPES.points, cut, n) for n in range(3)] == pytest.approx([12, 5, 1.5])


def test_a_concave_or_pierced_cell_shows_no_fan_across_its_hollow():
    cut = cells(SHAPES)
    sizes = np.diff(cut.offsets, prepend=0)
    assert set(sizes[cut.polygon != 2]) == {3}
    assert list(sizes[cut.polygon == 2]) == [4]


def test_clockwise_rings_are_convex_too():
    assert drawable(Polygons.from_vertices([SQUARE[::-1]]))[0]


@pytest.fixture(scope="module")
def files(memory_run, tmp_path_factory):
    folder = tmp_path_factory.mktemp("paraview")
    return folder, write_paraview(memory_run, folder)


def test_the_collection_holds_every_frame_at_its_time_in_seconds(files):
    folder, opened = files
    assert [path.name for path in opened] == ["blocks.pvd", "contacts.pvd"]
    for path in opened:
        entries = list(ElementTree.parse(path).iter("DataSet"))
        assert [float(entry.get("timestep")) for entry in entries] == [0.1 * n for n in range(4)]
        assert all((folder / entry.get("file")).exists() for entry in entries)


def test_points_are_those_before_the_run_so_that_warping_by_one_is_true(files, memory_run):
    frame = memory_run.frames[3]
    read = parsed(files[0] / "blocks_000003.vtu")
    displacement = read["PointData", "displacement"]
    assert displacement.shape == (len(frame.points), 3)
    warped = read["Points", "Points"] + displacement
    assert np.allclose(warped[:, :2], frame.points, rtol=0, atol=1e-15)
    assert not warped[:, 2].any()


def test_vtk_reads_the_blocks(files, memory_run):
    grid, to_numpy = read_by_vtk(files[0] / "blocks_000003.vtu")
    frame, topology = memory_run.frames[3], memory_run.topologies[0]
    assert grid.GetNumberOfPoints() == len(frame.points)
    assert grid.GetNumberOfCells() == 40  # Voronoi cells are convex: one cell a block
    stress = grid.GetCellData().GetArray("stress")
    assert [stress.GetComponentName(i) for i in range(3)] == ["xx", "yy", "xy"]
    order = cells(topology.elements).polygon
    assert np.array_equal(to_numpy(stress), frame.stress[order])
    material = to_numpy(grid.GetCellData().GetArray("material"))
    assert np.array_equal(material, topology.element_material[order])
    assert np.array_equal(to_numpy(grid.GetCellData().GetArray("block")), order)
    assert areas_by_vtk(grid, to_numpy) == pytest.approx(topology.elements.areas[order], rel=1e-12)


def test_vtk_reads_the_contacts(files, memory_run):
    grid, to_numpy = read_by_vtk(files[0] / "contacts_000003.vtu")
    frame = memory_run.frames[3]
    data = grid.GetPointData()
    assert grid.GetNumberOfCells() == len(frame.contact_state)
    assert np.array_equal(to_numpy(data.GetArray("state")), frame.contact_state)
    force = to_numpy(data.GetArray("force"))
    size = np.hypot(*frame.contact_force.T)
    assert np.allclose(np.linalg.norm(force, axis=1), size, rtol=1e-12)


def test_a_pierced_block_is_read_with_its_hole(tmp_path, memory_run):
    points = np.zeros_like(SHAPES.points)
    empty = {
        name: np.zeros((0, *getattr(memory_run.frames[0], name).shape[1:]))
        for name in vars(memory_run.frames[0])
        if name.startswith("contact_")
    }
    frame = replace(
        memory_run.frames[0],
        points=SHAPES.points,
        displacement=points,
        velocity=points,
        stress=np.zeros((3, 3)),
        **empty,
    )
    topology = Topology(SHAPES, np.arange(3), np.zeros(3, dtype=np.int64), ("rock",))
    (tmp_path / "a.vtu").write_text(blocks_grid(frame, topology, cells(SHAPES)))
    grid, to_numpy = read_by_vtk(tmp_path / "a.vtu")
    block = to_numpy(grid.GetCellData().GetArray("block"))
    assert np.bincount(block, weights=areas_by_vtk(grid, to_numpy)) == pytest.approx([12, 5, 1.5])


def test_a_run_without_contacts_has_no_contact_files(tmp_path, memory_run):
    frame = memory_run.frames[0]
    none = {name: value[:0] for name, value in vars(frame).items() if name.startswith("contact_")}
    sink = MemorySink()
    sink.topologies = memory_run.topologies
    sink.frames = [replace(frame, **none)]
    assert [path.name for path in write_paraview(sink, tmp_path)] == ["blocks.pvd"]


def test_frames_at_one_time_are_numbered():
    assert output_times([1.0, 1.0, 1.0, 1.0]) == [0, 1, 2, 3]


def test_tension_on_an_upper_side_pulls_the_lower_side_up(memory_run):
    frame = replace(
        memory_run.frames[0],
        contact_normal=np.array([[0.0, 1.0]]),
        contact_force=np.array([[5.0, 2.0]]),
    )
    # side a is above: tension 5 lifts b; the tangent points to +x, as in `contact.sides`
    assert contact_vectors(frame).tolist() == [[2.0, 5.0]]
