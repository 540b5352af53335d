"""Multipliers that boundaries through a mesh can carry: tractions of polynomial stresses.

A multiplier on every cut piece of boundary is more than the displacements can answer (Béchet, Moës
and Wohlmuth 2009). So the pieces of an edge are gathered in groups of two cells and more, and on
each group the multipliers are the tractions ``sigma n`` of all polynomial stresses of a degree:
along a straight line polynomials of the arc, around corners what no line of its own has room for.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_array

from covers.concatenate import numbers
from integration.arrays import Bools, Floats, Ints
from integration.monomials import evaluate, exponents
from integration.plane_vectors import counterclockwise
from nmm.assembly.model import Model
from nmm.constraints.interface import Interface
from nmm.contact.detection.surface import unordered_key

# Length of a group in cells; kink (rad) at which a line ends; a function that the others resemble
# to this share is left out: what is left of it alternates from piece to piece.
CELLS, KINK, ALIKE = 2.0, 0.5, 0.1
# The same for tractions of uniform stress: those along a straight line differ by rounding.
SAME = 1e-6
# Ends of pieces within this many cells are one point.
TOUCH = 1e-6


@dataclass(frozen=True)
class FacePieces:
    """Pieces of boundary with their Gauss points.

    Attributes
    ----------
    start, end
        (s, 2) ends (m); pieces that follow one another run in one direction.
    line
        (s,) what a piece belongs to: pieces of different numbers are never gathered.
    piece
        (m,) the piece of each point.
    position, normal
        (m, 2) of the points.
    weight
        (m,) area of boundary (m2).
    """

    start: Floats
    end: Floats
    line: Ints
    piece: Ints = field(metadata=numbers("piece"))
    position: Floats
    normal: Floats
    weight: Floats


def pieces_of(model: Model, interface: Interface) -> FacePieces:
    """Return the pieces of an interface.

    Multipliers end where a body does: across two of different stiffness a traction jumps.
    """
    place, manifold = interface.first, model.manifold
    assert place.normal is not None
    assert place.piece is not None
    x, piece, length = place.position, place.piece, place.piece_lengths
    sums = [np.bincount(piece, place.weight * x[:, k]) for k in (0, 1)]
    middle = np.stack(sums, axis=1) / length[:, None]
    at = np.searchsorted(piece, np.arange(len(length)))
    normal = place.normal[at]
    # The material is on the left of an edge, and its normal points to the right.
    along = counterclockwise(normal) * length[:, None] / 2
    line = manifold.element_body[place.elements[at]]
    if interface.second is not None:
        other = manifold.element_body[interface.second.elements[at]]
        along = np.where((line > other)[:, None], -along, along)
        line = unordered_key(line, other, manifold.n_bodies)
    return FacePieces(middle - along, middle + along, line, piece, x, place.normal, interface.area)


def traction_degree(model: Model) -> int:
    """Degree of the stresses of the polynomials that displacements hold where they are richest."""
    richest = model.manifold.richest
    return max((model.manifold.degree if richest is None else richest) - 1, 0)


def multipliers(pieces: FacePieces, size: float, degree: int, held: Bools) -> csr_array:
    """Multipliers (2m, k) at the points, component minor, alike in size.

    Parameters
    ----------
    size
        Size of a cell (m).
    degree
        Of the stresses.
    held
        (2,) whether x and y are held.
    """
    group, alone = groups(pieces, size)
    of_point = group[pieces.piece]
    order = np.argsort(of_point, kind="stable")
    bounds = np.searchsorted(of_point[order], np.arange(len(alone) + 1))
    rows, columns, values, k = [], [], [], 0
    for number in range(len(alone)):  # groups: a few for every ten cells of boundary
        chosen = order[bounds[number] : bounds[number + 1]]
        # One constant would leave the turn about the middle free.
        p = max(degree, 1) if alone[number] else degree
        basis = _tractions(
            pieces.position[chosen], pieces.normal[chosen], pieces.weight[chosen], p, held
        )
        row = (2 * chosen[:, None] + np.arange(2)).ravel()
        rows.append(np.repeat(row, basis.shape[1]))
        columns.append(np.tile(k + np.arange(basis.shape[1]), len(row)))
        values.append(basis.ravel())
        k += basis.shape[1]
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    return csr_array(entries, shape=(2 * len(pieces.weight), k))


def groups(pieces: FacePieces, size: float) -> tuple[Ints, Bools]:
    """Group (s,) of each piece, and whether a group (g,) is the only one of its chain."""
    group = np.empty(len(pieces.start), dtype=np.int64)
    alone: list[bool] = []
    for chain in _chains(pieces, size):  # chains: one for each edge or interface
        chain = _from_a_corner(pieces, chain, size)
        parts = _parts(pieces, chain, CELLS * size)
        for part in parts:
            group[part] = len(alone)
            alone.append(len(parts) == 1)
    return group, np.array(alone, dtype=bool)


def _chains(pieces: FacePieces, size: float) -> list[Ints]:
    """Pieces in the order in which they follow one another."""
    n = len(pieces.start)
    every = np.round(np.concatenate([pieces.start, pieces.end]) / (TOUCH * size)).astype(np.int64)
    key = np.column_stack([np.tile(pieces.line, 2), every])
    _, point = np.unique(key, axis=0, return_inverse=True)
    start, end = point.ravel()[:n], point.ravel()[n:]
    # Where more than one piece starts or ends the chain is cut.
    starts, ends = (np.bincount(p, minlength=2 * n) for p in (start, end))
    at = np.full(2 * n, -1, dtype=np.int64)
    at[start] = np.arange(n)
    after = np.where((starts[end] == 1) & (ends[end] == 1), at[end], -1)
    after = np.where(after == np.arange(n), -1, after)
    headed = np.zeros(n, dtype=bool)
    headed[after[after >= 0]] = True
    chains, seen = [], np.zeros(n, dtype=bool)
    for first in [*np.flatnonzero(~headed).tolist(), *range(n)]:  # closed chains last
        chain, piece = [], first
        while piece >= 0 and not seen[piece]:  # pieces one after the other
            seen[piece] = True
            chain.append(piece)
            piece = int(after[piece])
        if chain:
            chains.append(np.array(chain, dtype=np.int64))
    return chains


def _from_a_corner(pieces: FacePieces, chain: Ints, size: float) -> Ints:
    """A chain as it is; a closed one from its sharpest corner on, however pieces are numbered.

    Of corners alike it is the one furthest to the left, and the lowest of these.
    """
    start, end = pieces.start[chain], pieces.end[chain]
    if np.abs(end[-1] - start[0]).max() > TOUCH * size:
        return chain
    along = (end - start) / np.hypot(*(end - start).T)[:, None]
    straight = np.round(np.sum(along * np.roll(along, 1, axis=0), axis=1), 6)
    x, y = np.round(start / (TOUCH * size)).T
    return np.roll(chain, -int(np.lexsort((y, x, straight))[0]))


def _parts(pieces: FacePieces, chain: Ints, wanted: float) -> list[Ints]:
    """Parts of a chain as long as wanted, or about: of its straight runs, or of short ones joined.

    A part ends where the chain has a kink if it is long enough by then.
    """
    along = pieces.end[chain] - pieces.start[chain]
    length = np.hypot(*along.T)
    angle = np.arctan2(along[:, 1], along[:, 0])
    turn = np.abs((np.diff(angle) + np.pi) % (2 * np.pi) - np.pi)
    runs = np.split(np.arange(len(chain)), np.flatnonzero(turn > KINK) + 1)
    joined: list[list[int]] = []
    open_length = np.inf
    for piece in runs:  # straight runs of a chain
        own = float(length[piece].sum())
        if joined and ((open_length < wanted and own < wanted) or own < wanted / 4):
            joined[-1].extend(piece.tolist())
            open_length += own
        else:
            joined.append(piece.tolist())
            open_length = own
    parts = []
    for places in joined:
        run = np.array(places, dtype=np.int64)
        reach = np.cumsum(length[run])
        # The nearest number: rounded down, what ends at a body would be up to twice as coarse.
        number = max(int(reach[-1] / wanted + 0.5), 1)
        at = (reach - length[run] / 2) * number / reach[-1]
        interval = np.minimum(at.astype(int), number - 1)
        parts += [chain[run[interval == i]] for i in range(number)]
    return [part for part in parts if len(part)]


def _tractions(x: Floats, normal: Floats, weight: Floats, degree: int, held: Bools) -> Floats:
    """Orthonormal tractions (2m, k) of polynomial stresses at points."""
    middle = weight @ x / weight.sum()
    scale = max(float(np.abs(x - middle).max()), 1e-300)
    powers = exponents(degree).sum(axis=1)
    monomial = evaluate((x - middle) / scale, degree)
    nx, ny = normal.T
    zero = np.zeros_like(nx)
    unit = np.stack([np.stack([nx, zero, ny], -1), np.stack([zero, ny, nx], -1)], axis=1)
    unit = unit * held[:, None]
    root = np.repeat(np.sqrt(weight), 2)[:, None]
    basis = np.zeros((2 * len(x), 0))
    for power in range(degree + 1):  # degree by degree, so that lower ones are all there
        new = np.einsum("mcj,mk->mckj", unit, monomial[:, powers == power])
        part = root * new.reshape(2 * len(x), -1)
        size = float(np.sqrt((part**2).sum(axis=0).max(initial=0.0)))
        for _ in range(2):  # orthogonal to rounding
            part = part - basis @ (basis.T @ part)
        left, value, _ = np.linalg.svd(part, full_matrices=False)
        # Uniform stress is held whatever the kinks: a patch test asks for all of it.
        alike = ALIKE if power else SAME
        basis = np.concatenate([basis, left[:, value > alike * size]], axis=1)
    return np.asarray(basis / root * np.sqrt(weight.sum()))
