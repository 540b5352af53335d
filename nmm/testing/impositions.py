"""What every method that holds supports and glue is held to."""

from dataclasses import replace

import numpy as np

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.assembly.state import State, initial_state
from nmm.constraints.imposition import Imposition, Method
from nmm.constraints.interface import Interface
from nmm.constraints.ties.shared_edges import gauss_interface, shared_edges
from nmm.effects.base import Instant
from nmm.formulation import CoverTable
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.testing.claims import claim, close, finite

# Sums of a few hundred terms of both signs.
EXACT = 1e-9
MESH = {"type": "triangles", "size": 0.4, "degree": 1, "angle": 0.3, "shift": (0.1, 0.2)}


def check_imposition(kind: type[Imposition], degree: int = 1, seed: int = 3) -> None:
    """Hold a method to what every one promises, between two bodies and against the ground.

    Its force is minus the slope of its energy and its matrix the slope of that force, symmetric;
    two bodies that move as one feel nothing of it, and the ground carries what its points say.
    Conditions are of the jump alone. Bodies are two squares that a mesh covers.

    Parameters
    ----------
    degree
        Of the local functions.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, by how much, and what was tolerated.
    """
    squares = [np.array([[x, 0.0], [x + 1, 0], [x + 1, 1], [x, 1]]) for x in (0.0, 1.0)]
    cover = CoverTable.model_validate({**MESH, "degree": degree})
    model = solid(Polygons.from_vertices(squares), cover, [Elastic(1.0, 0.3)] * 2, "strain")
    seam = gauss_interface(model, shared_edges(model))
    rng = np.random.default_rng(seed)
    ways = [rng.normal(size=model.manifold.n_unknowns) for _ in range(2)]
    method = Method(kind.__name__, MESH["size"], degree)  # type: ignore[arg-type]
    for where, interface in (("glue", seam), ("ground", replace(seam, second=None))):
        tie = kind.of_all(model, [interface], method)[0]
        name = f"{kind.__name__}, {where}"
        _slopes(tie, name, model, *ways)
        if tie.shared is None:
            _pairs(tie, name, model, ways[0])
        else:
            _conditions(tie, name, model)


def _at(model: Model, deformation: Floats) -> State:
    return replace(initial_state(model.manifold), deformation=deformation)


def _jump(interface: Interface, state: State) -> Floats:
    return interface.jump(interface.motions(state), Instant(0.0, 0.0))


def _slopes(tie: Imposition, name: str, model: Model, start: Floats, way: Floats) -> None:
    """Energies are quadratic, so that central differences are exact to rounding."""
    at = [_at(model, start + share * way) for share in (-1.0, 0.0, 1.0)]
    energy = [tie.energy(state, _jump(tie.interface, state)) for state in at]
    force = [tie.force(state, _jump(tie.interface, state)) for state in at]
    points = tie.point_forces(at[1], _jump(tie.interface, at[1]))
    finite(f"{name}: energy", energy)
    finite(f"{name}: force", force)
    claim(points.shape == (len(tie.interface), 2), f"{name}: point_forces of shape {points.shape}")
    row, column, value = tie.matrix(at[1])
    n = model.manifold.n_unknowns
    dense = np.zeros((n, n))
    np.add.at(dense, (row, column), value)
    size = float(np.abs(dense).max())
    close(f"{name}: matrix less its transpose", dense, dense.T, EXACT * size)
    largest = EXACT * max(1.0, float(np.abs(force[1] @ way)), *np.abs(energy))
    close(f"{name}: force on a way", force[1] @ way, (energy[0] - energy[2]) / 2, largest)
    change = (force[0] - force[2]) / 2
    close(f"{name}: matrix times a way", dense @ way, change, EXACT * max(1.0, size))


def _pairs(tie: Imposition, name: str, model: Model, start: Floats) -> None:
    """Forces of two bodies cancel, those of the ground are what its points carry."""
    modes = model.manifold.rigid_modes.toarray()
    together = np.stack([modes[:, axis::3].sum(axis=1) for axis in (0, 1)])
    state = _at(model, start)
    jump = _jump(tie.interface, state)
    total = together @ tie.force(state, jump)
    tolerance = EXACT * max(1.0, float(np.abs(tie.point_forces(state, jump)).sum()))
    if tie.interface.second is None:
        carried = tie.point_forces(state, jump).sum(axis=0)
        close(f"{name}: force on all bodies less that of its points", total, carried, tolerance)
        return
    close(f"{name}: force on both bodies", total, 0.0, tolerance)
    for way in together:
        moved = _at(model, way)
        force = tie.force(moved, _jump(tie.interface, moved))
        close(f"{name}: force of two bodies that move as one", force, 0.0, tolerance)


def _conditions(tie: Imposition, name: str, model: Model) -> None:
    """Conditions of bodies without a jump ask for nothing."""
    still = _at(model, np.zeros(model.manifold.n_unknowns))
    rows, sides = tie.conditions(still, _jump(tie.interface, still))
    claim(rows.shape == (len(sides), len(still.deformation)), f"{name}: rows {rows.shape}")
    finite(f"{name}: conditions", rows.data)
    close(f"{name}: right-hand sides without a jump", sides, 0.0, EXACT)
