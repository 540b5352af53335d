"""Pictures of covers: physical covers that a crack parts are in two colours."""

import numpy as np
import pytest

import nmm
from covers.cutting.cut import cut
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons
from nmm import plots
from nmm.plots.results.covers import apart

PLATE = Polygons.from_vertices([[[0, 0], [2, 0], [2, 1], [0, 1]]])


@pytest.fixture(scope="module")
def parted():
    laid = Triangles.regular([[0, 0], [2, 1]], 0.25, angle=0.3, shift=(0.2, 0.4))
    return laid, cut(laid, PLATE, [[[1.0, -0.1], [1.05, 1.1]]])


def test_covers_chosen_for_the_picture_do_not_overlap(parted):
    _, pieces = parted
    chosen = apart(pieces)
    number = np.isin(pieces.covers, chosen).sum(axis=1)
    assert number.max() == 1
    # Patches that the crack parts come first: both their covers are there.
    patches, count = np.unique(pieces.cover_patch[chosen], return_counts=True)
    assert (count == 2).any()
    assert len(patches) > 5


def test_both_parts_of_a_patch_have_colours_of_their_own(parted):
    laid, pieces = parted
    axes = plots.covers(laid, pieces)
    assert [len(panel.collections) > 1 for panel in axes] == [True] * 3
    chosen = apart(pieces)
    faces = axes[1].collections[1].get_facecolor()
    element, slot = np.nonzero(np.isin(pieces.covers, chosen))
    cover = pieces.covers[element, slot]
    patch = pieces.cover_patch[cover]
    for number in np.unique(patch):
        mine = patch == number
        colours = {tuple(face) for face in faces[mine]}
        assert len(colours) == len(np.unique(cover[mine]))


SCENE = """
title = "plate"
plane = "stress"
[materials.steel]
young_modulus = 2e11
poisson_ratio = 0.3
[[blocks]]
material = "steel"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "wall"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1e6, 0]
[formulation.cover]
type = "triangles"
size = 0.5
"""


def test_a_run_on_a_mesh_has_a_picture_of_its_covers(tmp_path):
    scene = nmm.parse_scene(SCENE, "plate")
    done = nmm.run(scene, out=tmp_path / "run")
    stored = nmm.read_run(done.folder)
    files = plots.draw_all(stored, tmp_path / "pictures", scene=scene)
    assert tmp_path / "pictures/covers.png" in files
    assert (tmp_path / "pictures/covers.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert "history.png" not in {file.name for file in files}  # one step is no curve
