"""Nested dissection by METIS (Karypis, Kumar 1998), where the package pymetis is installed."""

from functools import cache
from typing import Any

import numpy as np

from integration.arrays import Index, Ints
from integration.ragged import offsets
from nmm.solvers.libraries.optional import METIS


@cache
def metis() -> Any:
    """Return the package; None where it is not installed or does not load."""
    return METIS.load("cholesky") if METIS.loads else None


def ordering() -> str:
    """Name of what dissects large graphs, for summaries."""
    return "METIS" if metis() is not None else "nested dissection of its own"


def metis_order(ptr: Index, graph: Index, weight: Ints) -> Ints:
    """Order of elimination of the nodes of a graph that lists each node beside itself.

    See `nmm.solvers.frontal.dissection.dissect`.
    """
    owner = np.repeat(np.arange(len(ptr) - 1), np.diff(ptr))
    others = graph != owner
    starts = offsets(np.bincount(owner[others], minlength=len(ptr) - 1))
    package = metis()
    adjacency = package.CSRAdjacency(starts.astype(np.int32), graph[others])
    order, _ = package.nested_dissection(adjacency, vweights=weight.astype(np.int32))
    return np.asarray(order, dtype=np.int64)
