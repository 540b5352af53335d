"""Exact contact over faces of meshes: no more conditions than fields can follow."""

import numpy as np
import pytest

from nmm.assembly.state import initial_state
from nmm.contact.mortar.face_means import FaceMeans
from nmm.contact.mortar.trace_space import TraceSpace
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.prepare import prepare
from nmm.stepping.run import run
from nmm.verification import text
from nmm.verification.text import G

WEIGHT = 2600 * G
TILTED = "angle = 0.2\nshift = [0.3, 0.1]\n"
NETS = '[[cover.nets]]\nblock = "top"\nsize = 0.23\n'


def formulation(kind, degree, net=TILTED, size=0.4, nets=NETS, enforcement="lagrange"):
    return parse_formulation(
        f'[cover]\ntype = "{kind}"\ndegree = {degree}\nsize = {size}\n{net}{nets}'
        f'[contact]\nenforcement = "{enforcement}"\n'
    )


def scene(lean=0.0, friction=30.0, more="", width=1.0):
    """A square on a held floor under gravity that leans."""
    lean = np.radians(lean)
    push = [-G * float(np.sin(lean)), -G * float(np.cos(lean))]
    return parse_scene(
        text.scene(
            f'plane = "stress"\n[gravity]\nacceleration = {push}\n[contact]\n{more}',
            [
                text.material("rock", poisson=0.0),
                *text.floor(friction),
                text.block("top", "rock", text.rectangle((0, 0), (width, 1))),
            ],
        )
    )


def faces(kind, degree, **options):
    """Contacts at the start, their functions and the effect."""
    simulation = prepare(scene(), formulation(kind, degree, **options))
    contact = simulation.stepper.plan.contact
    state = initial_state(simulation.stepper.model.manifold)
    found = contact.candidates(state, 1e-6)
    weak = FaceMeans.of(found, contact.partners.surface(state), contact.geometry.trace_space)
    return found, weak, contact, state


MESHES = [("triangles", 0), ("triangles", 1), ("triangles", 2), ("quads", 0), ("quads", 1)]


@pytest.mark.parametrize(("kind", "degree"), MESHES)
def test_a_uniform_pressure_is_one_of_those_that_functions_make(kind, degree):
    found, weak, _, _ = faces(kind, degree)
    on_face = found.length > 0
    # Forces of the unit pressure on all functions are the lengths of the points.
    forces = weak.share.T @ (weak.functions @ found.length)
    assert forces[on_face] == pytest.approx(found.length[on_face], rel=1e-13)
    assert weak.functions.sum(axis=0) == pytest.approx(1.0, rel=1e-13)
    assert weak.functions.data.min() > 0


def determined(rows, stiffness):
    """Smallest eigenvalue of the compliance of unit forces on rows, over the mean."""
    soft = 1 / np.sqrt(np.maximum(stiffness, 1e-12 * stiffness.max()))
    some = rows.multiply(soft).toarray()
    some /= np.linalg.norm(some, axis=1)[:, None]
    return np.linalg.svd(some, compute_uv=False)[-1] ** 2


@pytest.mark.parametrize(("kind", "degree"), MESHES)
def test_forces_of_the_functions_are_determined_where_those_of_points_are_not(kind, degree):
    found, weak, contact, state = faces(kind, degree)
    normal = contact.geometry.rows(found, state).normal
    stiffness = contact.geometry.model.stiffness.diagonal()
    on_face = np.flatnonzero(found.length > 0)
    assert determined(normal[on_face], stiffness) < 1e-4
    assert determined((weak.share @ normal), stiffness) > 1e-2


@pytest.mark.parametrize("degree", [0, 1])
def test_on_a_mesh_that_fits_the_face_places_are_its_nodes(degree):
    fitting = {"net": "", "size": 0.25, "nets": ""}
    _, _, contact, _ = faces("quads", degree, **fitting)
    edges, space = contact.geometry.sides.manifold.boundary, contact.geometry.trace_space
    assert isinstance(space, TraceSpace)
    # The square has 4 cells a side, the floor 16 x 4: as many intervals as edges.
    assert len(edges) == 16 + 40
    assert len(space.node) == len(edges) + 8


@pytest.mark.parametrize("enforcement", ["lagrange", "augmented", "cone"])
@pytest.mark.parametrize(("kind", "degree"), [("triangles", 0), ("triangles", 1), ("quads", 1)])
def test_a_square_that_hardly_stands_presses_on_its_corner(kind, degree, enforcement):
    # It topples at 45 degrees; at 44 the resultant is (1 - tan 44) / 2 = 0.017 from the corner,
    # where hats without functions of their own at the ends reach a third of a cell, 0.08.
    found = run(scene(44.0, 60.0), formulation(kind, degree, enforcement=enforcement))
    assert found.summary.status == "converged", found.summary.sentence
    frame = found.frames[-1]
    normal, shear = -frame.contact_force.T
    down, along = WEIGHT * np.cos(np.radians(44.0)), WEIGHT * np.sin(np.radians(44.0))
    assert normal.sum() == pytest.approx(down, rel=1e-6)
    assert abs(shear.sum()) == pytest.approx(along, rel=1e-6)
    arm = frame.contact_position[:, 0] @ normal / normal.sum()
    # The square has turned by the give of the corner, of 1e-4 at most.
    assert arm == pytest.approx((1 - np.tan(np.radians(44.0))) / 2, abs=2e-4)
    assert (np.abs(shear) <= np.tan(np.radians(60.0)) * normal * (1 + 1e-6) + 1e-9).all()


@pytest.mark.parametrize(("kind", "degree"), [("triangles", 0), ("triangles", 1), ("quads", 1)])
def test_a_square_on_a_slope_slides_by_coulombs_law(kind, degree):
    motion = "[formulation.integrator]\nstep = 0.005\n"
    head = 'plane = "stress"\nduration = 0.1\n[inertia]\n[gravity]\n'
    lean = np.radians(35.0)
    push = [-G * float(np.sin(lean)), -G * float(np.cos(lean))]
    sliding = parse_scene(
        text.scene(
            f"{head}acceleration = {push}\n[contact]\n{motion}",
            [
                text.material("rock", poisson=0.0),
                *text.floor(20.0),
                text.block("top", "rock", text.rectangle((0, 0), (1, 0.5))),
                text.monitor("middle", (0.5, 0.25), "top"),
            ],
        )
    )
    chosen = formulation(kind, degree)
    chosen = chosen.model_copy(update={"integrator": sliding.formulation.integrator})
    found = run(sliding, chosen)
    assert found.summary.status == "converged", found.summary.sentence
    fall = G * (np.sin(lean) - np.tan(np.radians(20.0)) * np.cos(lean))
    way = found.history["monitor:middle:ux"][-1]
    # Shi's rule moves uniformly accelerated bodies exactly; waves of the start shear the block.
    assert way == pytest.approx(-fall * 0.1**2 / 2, rel=2e-3)
    rubbed = np.tan(np.radians(20.0)) * 0.5 * WEIGHT * np.cos(lean) * -way
    assert found.history["friction_loss"][-1] == pytest.approx(rubbed, rel=1e-3)


LINEAR = {
    "quads": "size = 0.45\ndegree = 1",
    "graded": "size = 0.45\ndegree = 1",
    "triangles": "size = 0.4\ndegree = 1",
    "bspline": "size = 0.45\ndegree = 1",
}
HEIGHT, MODULUS, PRESS, LEAN = 0.6, 1e8, 1e5, 0.8


def column():
    """Two blocks of three cells under a pressure that is linear across them; no contraction."""
    top = [[0, 2 * HEIGHT], [1, 2 * HEIGHT]]
    return text.scene(
        'plane = "stress"\n[contact]\n[formulation.rotation]\nupdate = "small"\n',
        [
            text.material("rock", modulus=MODULUS, poisson=0.0, density=None),
            text.interface("rough", 60.0),
            text.block("low", "rock", text.rectangle((0, 0), (1, HEIGHT))),
            text.block("top", "rock", text.rectangle((0, HEIGHT), (1, 2 * HEIGHT))),
            f'[[supports]]\nname = "base"\nsegment = {[[0, 0], [1, 0]]}\nfix = ["x", "y"]\n',
            f'[[loads]]\nname = "p"\nkind = "edge"\nsegment = {top}\n'
            f'field = ["0", "{-PRESS} * (1 + {LEAN} * (2 * x - 1))"]\n',
            text.monitor("corner", (1, 2 * HEIGHT), "top"),
        ],
    )


@pytest.mark.parametrize("enforcement", ["lagrange", "augmented", "cone"])
@pytest.mark.parametrize("kind", LINEAR)
def test_a_pressure_that_is_linear_along_a_face_passes_it_as_in_one_body(kind, enforcement):
    held = '[supports]\nmethod = "lagrange"\n[rotation]\nupdate = "small"\n'
    cover = f'[cover]\ntype = "{kind}"\n{LINEAR[kind]}\n'
    chosen = parse_formulation(f'{cover}{held}[contact]\nenforcement = "{enforcement}"\n')
    found = run(parse_scene(column()), chosen).history
    # u_y = y p(x) / E and u_x = -y^2 p' / (2 E), of degree 2: solved to 1e-8 of the forces.
    y, slope = 2 * HEIGHT, -PRESS * LEAN * 2
    right = {"ux": -(y**2) * slope / (2 * MODULUS), "uy": -y * PRESS * (1 + LEAN) / MODULUS}
    for name, value in right.items():
        assert found[f"monitor:corner:{name}"][-1] == pytest.approx(value, rel=1e-6)
    assert found["penetration"][-1] < 1e-6 * y
