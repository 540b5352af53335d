"""Faces of meshes on each other: gaps of rounding, near parallels, stiff springs, odd places."""

import numpy as np
import pytest

from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text

WEIGHT = 2600 * text.G
MESHES = {
    "finite elements": 'type = "triangles"\ndegree = 0\n',
    "manifold": 'type = "triangles"\ndegree = 1\n',
    "quads": 'type = "quads"\ndegree = 2\n',
}
NETS = 'size = 0.4\nangle = 0.2\nshift = [0.3, 0.1]\n[[cover.nets]]\nblock = "top"\nsize = 0.23\n'


def slow(*values):
    return pytest.param(*values, marks=pytest.mark.slow)


def formulation(mesh, **contact):
    lines = "".join(
        f'{key} = "{value}"\n' if isinstance(value, str) else f"{key} = {value!r}\n"
        for key, value in contact.items()
    )
    return parse_formulation(f"[cover]\n{MESHES[mesh]}{NETS}[contact]\n{lines}")


def resting(gap, tilt, mesh, **contact):
    """A square on a held floor, a net for each."""
    square = text.turned(text.rectangle((0, 0), (1, 1)), tilt) + np.array([0.0, gap])
    scene = text.scene(
        'plane = "stress"\n[gravity]\n[contact]\n',
        [text.material("rock"), *text.floor(), text.block("top", "rock", square)],
    )
    found = run(parse_scene(scene), formulation(mesh, **contact))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def pressed(mesh, turn=0.0, shift=(0.0, 0.0), backwards=False, **contact):
    """Largest error of the stress of the contact patch test, wherever it stands."""

    def place(points):
        return text.turned(np.array(points, dtype=float), turn) + shift

    def edge(points):
        return place(points).tolist()

    across = text.turned(np.array([(0.0, -1.0)]), turn)[0].tolist()
    blocks = [
        text.block("low", "soft", place(text.rectangle((-1.5, -1), (1.5, 0)))),
        text.block("top", "soft", place(text.rectangle((-0.5, 0), (0.5, 1)))),
    ]
    loads = {
        "middle": ("top", [(-0.5, 1), (0.5, 1)], across),
        "left": ("low", [(-1.5, 0), (-0.5, 0)], across),
        "right": ("low", [(0.5, 0), (1.5, 0)], across),
        "foot": ("low", [(-1.5, -1), (1.5, -1)], [-across[0], -across[1]]),
    }
    scene = text.scene(
        'plane = "stress"\n[contact]\n',
        [
            text.material("soft", modulus=1000.0, poisson=0.0, density=None),
            text.interface("rough", 30.0),
            *(blocks[::-1] if backwards else blocks),
            f'[[supports]]\nname = "foot"\npoint = {edge([(0, -1)])[0]}\nfix = ["x", "y"]\n',
            f'[[supports]]\nname = "side"\npoint = {edge([(1.5, -1)])[0]}\n'
            f"fix = {['y' if abs(across[1]) > 0.5 else 'x']}\n",
            *(
                f'[[loads]]\nname = "{name}"\nkind = "edge"\nblock = "{block}"\n'
                f"segment = {edge(points)}\ntraction = {traction}\n"
                for name, (block, points, traction) in loads.items()
            ),
        ],
    )
    found = run(parse_scene(scene), formulation(mesh, **contact))
    assert found.summary.status == "converged", found.summary.sentence
    # The mean turn of the bodies carries the stress in their own axes with it.
    c, s = np.cos(turn), np.sin(turn)
    expected = -np.array([s * s, c * c, -s * c])
    return float(np.abs(found.stress - expected).max())


@pytest.mark.parametrize("mesh", ["finite elements", "manifold", slow("quads")])
@pytest.mark.parametrize("gap", [0.0, 1e-12, -1e-12, slow(1e-9), slow(-1e-9)])
def test_gaps_of_rounding_do_not_matter(mesh, gap):
    force = -resting(gap, 0.0, mesh).contact_forces[:, 0].sum()
    assert force == pytest.approx(WEIGHT, rel=1e-7)


@pytest.mark.parametrize(
    ("mesh", "tilt"),
    [
        ("finite elements", 1e-14),
        ("finite elements", 1e-6),
        slow("finite elements", 1e-4),
        slow("manifold", 1e-14),
        slow("manifold", 1e-10),
        slow("manifold", 1e-6),
        slow("quads", 1e-10),
    ],
)
def test_a_square_tilted_by_next_to_nothing_comes_to_lie_on_its_face(mesh, tilt):
    found = resting(0.0, tilt, mesh)
    assert -found.contact_forces[:, 0].sum() == pytest.approx(WEIGHT, rel=1e-7)
    # Moment about the middle of the face; the centre moves by the tilt.
    frame = found.frames[-1]
    moment = frame.contact_position[:, 0] @ -frame.contact_force[:, 0]
    assert moment == pytest.approx(0.5 * WEIGHT, rel=1e-6 + tilt)


@pytest.mark.parametrize("mesh", ["finite elements", "manifold"])
@pytest.mark.parametrize("penalty", [1.0, slow(1e2), slow(1e4), 1e6])
def test_springs_of_any_stiffness_pass_a_uniform_pressure(mesh, penalty):
    # Benchmark D4: resultants to 1e-6; the bodies turn by the penetration.
    assert pressed(mesh, normal_penalty=penalty) < 1e-6


CHANGES = {
    "turned by 0.3": {"turn": 0.3},
    "turned by 90 degrees": {"turn": np.pi / 2},
    "numbered backwards": {"backwards": True},
    "a kilometre away": {"shift": (1e3, -1e3)},
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_uniform_pressure_passes_wherever_the_blocks_stand(change):
    assert pressed("finite elements", **change) < 1e-6


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("enforcement", ["lagrange", slow("augmented"), slow("cone")])
def test_exact_contact_with_friction_passes_a_uniform_pressure(mesh, enforcement):
    # Rounds end at residuals of 1e-8 of the load; the cone leaves overlaps of 1e-7 of what forces
    # press faces in by (`gap_tolerance`), ten times that in a stress, and 7e-9 with 1e-9 of it.
    allowed = {"lagrange": 1e-10, "augmented": 1e-7, "cone": 3e-6}
    assert pressed(mesh, enforcement=enforcement) < allowed[enforcement]


@pytest.mark.parametrize("mesh", MESHES)
def test_under_exact_contact_a_square_falls_by_a_tilt_on_its_face(mesh):
    found = resting(0.0, 1e-4, mesh, enforcement="lagrange")
    assert -found.contact_forces[:, 0].sum() == pytest.approx(WEIGHT, rel=1e-7)
