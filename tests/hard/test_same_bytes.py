"""The same run twice writes the same bytes, whatever the hash seed and the numbers of threads.

Frames, topologies, history, scene and formulation are compared byte by byte; the summary holds
seconds and memory, and its other fields are compared. Each run is a process of its own, as hash
seed and threads are read at its start.
"""

import pytest

from nmm.shipped import example
from nmm.testing.resumed.killing import apart, check_same_files

RUN = "import sys, nmm; nmm.run(nmm.read_scene(sys.argv[1]), out=sys.argv[2])"

# Seed of hashes and threads, of the linear algebra and of numba.
PLAIN, OTHER = ("0", "1"), ("4242", "4")

HEAD = """
plane = "strain"
[materials.rock]
density = 2500
young_modulus = "1 GPa"
poisson_ratio = 0.2
[materials.soil]
density = 1800
young_modulus = "50 MPa"
poisson_ratio = 0.3
"""

PILE = """
[inertia]
[gravity]
[contact]
[interfaces.any]
friction_angle = "25 deg"
[[tessellations]]
name = "pile"
material = "rock"
region = [[0, 0.005], [2, 0.005], [2, 2], [0, 2]]
blocks = {blocks}
seed = 3
[[blocks]]
name = "floor"
material = "soil"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
[[monitors]]
name = "top"
point = [1, 1.999]
[formulation.integrator]
step = "2 ms"
[formulation.contact]
enforcement = "{enforcement}"
"""

MESH = """
[[blocks]]
name = "beam"
material = "rock"
vertices = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[blocks]]
name = "cap"
material = "soil"
vertices = [[0, 1], [4, 1], [4, 1.5], [0, 1.5]]
[interfaces.any]
bonded = true
friction_angle = "30 deg"
[[cracks]]
name = "notch"
points = [[2, 0], [2, 0.45]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[loads]]
name = "top"
kind = "edge"
segment = [[0, 1.5], [4, 1.5]]
traction = [0, "-10 kPa"]
[formulation.cover]
type = "{cover}"
size = {size}
degree = {degree}
[formulation.solver]
type = "{solver}"
"""

SCENES = {
    "pile": 'duration = "16 ms"' + HEAD + PILE.format(blocks=30, enforcement="penalty"),
    "mesh_triangles": HEAD + MESH.format(cover="triangles", size=0.21, degree=1, solver="auto"),
}
SLOW = {
    "mesh_superlu": HEAD + MESH.format(cover="triangles", size=0.21, degree=0, solver="superlu"),
    "mesh_quads": HEAD + MESH.format(cover="quads", size=0.15, degree=2, solver="auto"),
    "pile_cone": 'duration = "30 ms"' + HEAD + PILE.format(blocks=12, enforcement="cone"),
    "kitoh": example("kitoh_beam/kitoh_130.toml").read_text().replace("# motion", "motion"),
    "large_pile": 'duration = "30 ms"' + HEAD + PILE.format(blocks=250, enforcement="penalty"),
    "pile_augmented": 'duration = "30 ms"' + HEAD + PILE.format(blocks=12, enforcement="augmented"),
    "pile_lagrange": 'duration = "30 ms"' + HEAD + PILE.format(blocks=12, enforcement="lagrange"),
    "pile_barrier": 'duration = "30 ms"' + HEAD + PILE.format(blocks=12, enforcement="barrier"),
    "mesh_fine": HEAD + MESH.format(cover="quads", size=0.04, degree=1, solver="auto"),
    "mesh_lu": HEAD + MESH.format(cover="quads", size=0.1, degree=1, solver="lu"),
}
ALL = [*SCENES, *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW)]


def write(folder, scene, seed, threads):
    """Run a scene in a process of its own."""
    counts = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
    done = apart(RUN, scene, folder, PYTHONHASHSEED=seed, **dict.fromkeys(counts, threads))
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.parametrize("name", ALL)
def test_a_run_is_the_same_bytes_for_any_hash_seed_and_threads(tmp_path, name):
    scene = tmp_path / "scene.toml"
    scene.write_text((SCENES | SLOW)[name])
    first = write(tmp_path / "first", scene, *PLAIN)
    check_same_files(first, write(tmp_path / "other", scene, *OTHER))
