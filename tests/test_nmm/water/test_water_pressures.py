"""Water pressures: resultants, kinks, faces of cracks, and faults by line."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing import check_effect_of

BLOCK = """
title = "t"
plane = "strain"
thickness = 0.7
[materials.m]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2000.0
hydraulic_conductivity = 1e-6
specific_storage = 1e-4
[[blocks]]
name = "b"
material = "m"
vertices = [[0.3, 0.1], [2.1, 0.4], [1.7, 1.9], [0.5, 1.6]]
[[supports]]
name = "foot"
block = "b"
fix = ["x", "y"]
"""
AREA = 0.5 * abs(
    sum(
        a[0] * b[1] - b[0] * a[1]
        for a, b in zip(
            [(0.3, 0.1), (2.1, 0.4), (1.7, 1.9), (0.5, 1.6)],
            [(2.1, 0.4), (1.7, 1.9), (0.5, 1.6), (0.3, 0.1)],
            strict=True,
        )
    )
)
COVERS = {
    "block": "",
    "cubic block": "[formulation.cover]\nfunctions = 'monomials'\ndegree = 3\n",
    "triangles": "[formulation.cover]\ntype = 'triangles'\nsize = 0.6\n",
    "quads": "[formulation.cover]\ntype = 'quads'\nsize = 0.6\ndegree = 2\n",
}


def water(more, cover="", block=BLOCK):
    return f'{block}[[water_pressures]]\nname = "w"\n{more}\n{cover}'


def resultant(text):
    history = nmm.run(nmm.parse_scene(text)).history
    return np.array([history["water pressures:w:x"][-1], history["water pressures:w:y"][-1]])


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("far", [0.0, 3e5])
def test_water_around_a_block_lifts_it_by_what_it_displaces(cover, far):
    moved = [[x + far, y + far] for x, y in [(0.3, 0.1), (2.1, 0.4), (1.7, 1.9), (0.5, 1.6)]]
    block = BLOCK.replace("[[0.3, 0.1], [2.1, 0.4], [1.7, 1.9], [0.5, 1.6]]", str(moved))
    found = resultant(water(f'block = "b"\nlevel = {far + 5.0}', COVERS[cover], block))
    weight = 9810.0 * AREA * 0.7
    # Archimedes; the coordinates of a far block are rounded to 1e-10 m.
    rounding = 1e-12 if not far else 1e-9
    assert found == pytest.approx([0.0, weight], abs=rounding * 9810 * 5 * 2)


def test_a_level_on_the_way_up_an_edge_is_met_exactly():
    text = water("segment = [[2.1, 0.4], [1.7, 1.9]]\nlevel = 1.123", COVERS["triangles"])
    depth = 1.123 - 0.4
    along = np.array([-0.4, 1.5]) / 1.5
    # A triangle of pressure over the wet part, along minus the normal (1.5, .4) / |.| of the edge.
    size = 9810 * depth / 2 * depth * np.hypot(*along) * 0.7
    normal = np.array([1.5, 0.4]) / np.hypot(1.5, 0.4)
    assert resultant(text) == pytest.approx(-size * normal, rel=1e-12)


def test_an_even_pressure_around_a_block_presses_it_evenly_and_does_not_move_it():
    held = '[[supports]]\nname = "foot"\nblock = "b"\nfix = ["x", "y"]\n'
    free = BLOCK.replace(held, "[[supports]]\nname='p'\npoint=[0.3, 0.1]\nfix=['x', 'y']\n")
    run = nmm.run(nmm.parse_scene(water('block = "b"\npressure = "2 MPa"', block=free)))
    assert run.history["water pressures:w:x"][-1] == pytest.approx(0.0, abs=1e-9 * 2e6)
    # The same in all directions of the plane, whatever the material; the rest is rounding.
    assert run.stress == pytest.approx(np.array([[-2e6, -2e6, 0.0]]), abs=1e-9 * 2e6)


def test_a_phreatic_line_with_a_bend_is_integrated_exactly():
    flat = BLOCK.replace(
        "[[0.3, 0.1], [2.1, 0.4], [1.7, 1.9], [0.5, 1.6]]", "[[0, 0], [4, 0], [4, 1], [0, 1]]"
    )
    line = "phreatic_line = [[0, 3], [1.3, 2], [4, -1]]"
    found = resultant(water(f"segment = [[0, 0], [4, 0]]\n{line}", "", flat))
    dry = 1.3 + 2.7 * 2 / 3
    wanted = 9810 * 0.7 * (1.3 * 2.5 + (dry - 1.3) * 2 / 2)
    assert found == pytest.approx([0.0, wanted], rel=1e-12)


def test_water_in_a_crack_pushes_its_faces_apart_and_the_body_nowhere():
    crack = '[[cracks]]\nname = "c"\npoints = [[0.7, 0.8], [1.6, 1.1]]\n'
    cover = "[formulation.cover]\ntype = 'triangles'\nsize = 0.15\n"
    free = BLOCK.replace('block = "b"\nfix', "point = [0.3, 0.1]\nfix")
    roller = '[[supports]]\nname = "r"\npoint = [2.1, 0.4]\nfix = ["y"]\n'
    text = water('crack = "c"\nlevel = 500.0', crack + roller + cover, free)
    run = nmm.run(nmm.parse_scene(text))
    sums = [run.history[f"water pressures:w:{axis}"][-1] for axis in "xy"]
    # Both faces feel the same pressure, of 5 MPa: nothing is left but rounding.
    assert np.abs(sums).max() < 1e-9 * 5e6
    assert run.summary.status == "converged"
    edges = run.manifold.boundary
    faces = edges.crack >= 0
    middle = (edges.start + edges.end)[faces] / 2
    rows = run.manifold.rows(edges.element[faces], middle)
    way = rows.apply(run.state.deformation)
    up = np.array([-0.3, 0.9]) / np.hypot(0.3, 0.9)
    upper = run.manifold.elements.centroids[edges.element[faces]] @ up > middle @ up
    assert (way[upper] @ up).mean() > (way[~upper] @ up).mean() + 1e-4


@pytest.mark.parametrize("cover", COVERS)
def test_water_keeps_what_every_effect_promises(cover):
    text = water('block = "b"\nlevel = 1.2', COVERS[cover])
    check_effect_of(nmm.parse_scene(text), "water pressures")


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ('block = "b"', "no pressure.*level, phreatic_line, pressure, pressures"),
        ("level = 1.0", "no place"),
        ('block = "b"\nlevel = 1.0\npressures = [1.0, 2.0]', "level, pressures"),
        ('block = "b"\npressures = [1.0, 2.0]', "pressures without segment"),
        ('crack = "c"\nlevel = 1.0', 'crack: "c": expected the name of a crack'),
        ('block = "d"\nlevel = 1.0', '"d": expected the name of a block'),
        ('block = "b"\nphreatic_line = [[1, 0], [0, 0]]', "x increasing"),
    ],
)
def test_what_contradicts_itself_is_refused_by_line(more, said):
    with pytest.raises(SceneError, match=said):
        nmm.parse_scene(water(more))


def test_water_on_no_edge_is_refused_by_line():
    with pytest.raises(SceneError, match="water_pressures.0: .*an edge of a block"):
        nmm.run(nmm.parse_scene(water("segment = [[7, 0], [8, 0]]\nlevel = 3.0")))


def test_seepage_keeps_what_every_effect_promises():
    seeping = '[seepage]\n[[heads]]\nname = "h"\nsegment = [[0.3, 0.1], [2.1, 0.4]]\nhead = 3.0\n'
    for cover in COVERS.values():
        check_effect_of(nmm.parse_scene(BLOCK + seeping + cover), "seepage")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[[heads]]\nname = "h"\nblock = "b"\nhead = 1.0\n', "no .seepage."),
        ("[seepage]\ntransient = true\n", "no initial head"),
        ("[seepage]\ntransient = true\ninitial = 2.0\n", "duration missing"),
    ],
)
def test_seepage_that_contradicts_itself_is_refused_by_line(text, said):
    with pytest.raises(SceneError, match=said):
        nmm.parse_scene(BLOCK + text)


def test_seepage_that_nothing_determines_names_the_block():
    with pytest.raises(SceneError, match="seepage: block b: nothing holds its head"):
        nmm.run(nmm.parse_scene(BLOCK + "[seepage]\n"))


def test_transient_seepage_keeps_its_water():
    text = BLOCK + (
        '[seepage]\ntransient = true\ninitial = 2.0\nduration = "1 day"\n'
        '[[heads]]\nname = "h"\nsegment = [[0.3, 0.1], [2.1, 0.4]]\nhead = 5.0\n'
        "[formulation.loading]\nincrement = 0.2\n" + COVERS["triangles"]
    )
    history = nmm.run(nmm.parse_scene(text)).history
    off = history["seepage:stored"] - history["seepage:taken:h"]
    assert abs(off).max() < 1e-10 * history["seepage:stored"][-1]


CRACKED = """
plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.25
[[blocks]]
name = "body"
material = "m"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[cracks]]
name = "notch"
points = [[1, 1], [1, 0.3]]
[[supports]]
name = "left"
point = [0, 0]
fix = ["x", "y"]
[[supports]]
name = "right"
point = [2, 0]
fix = ["y"]
[[monitors]]
name = "left lip"
point = [0.9999, 1]
[[monitors]]
name = "right lip"
point = [1.0001, 1]
[formulation.cover]
type = "quads"
size = 0.25
"""
WATER = '[[water_pressures]]\nname = "w"\nblock = "body"\npressure = 1e6\n'
GAS = '[[loads]]\nkind = "pressure"\nname = "g"\nblock = "body"\npressure = 1e6\n'


@pytest.mark.parametrize("pressed", [WATER, GAS], ids=["water", "pressure"])
def test_an_even_pressure_around_a_cracked_body_does_not_open_its_crack(pressed):
    # Its stress is that of a whole body. Two points along each edge opened it by 14 and 6 um.
    found = nmm.run(nmm.parse_scene(CRACKED + pressed)).history
    right, left = (found[f"monitor:{name} lip:ux"][-1] for name in ("right", "left"))
    strain = -1e6 / 1e9 * (1 + 0.25) * (1 - 2 * 0.25)
    # 1e-4 of what the pressure in the crack alone opens in a half plane, some 4 p a / E.
    assert right - left == pytest.approx(2e-4 * strain, abs=1e-4 * 4 * 1e6 * 0.7 / 1e9)
