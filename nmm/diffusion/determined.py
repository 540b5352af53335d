"""Bodies whose steady field is undetermined."""

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from integration.arrays import Ints
from nmm.diffusion.problem import DiffusionProblem

# What bodies give away when the field is one everywhere, over what they pass on: below is rounding.
ROUNDING = 1e-9


def undetermined(problem: DiffusionProblem) -> Ints:
    """Return the bodies without a prescribed value, an exchange, or a joint to a body with one."""
    space, n = problem.space, problem.space.manifold.n_bodies
    owner = csr_array((space.one, (np.arange(space.n), space.body)), shape=(space.n, n))
    # Of a field that is constant in each body edges feel values and jumps alone.
    passed = csr_array((n, n))
    for edge in problem.edges:  # a handful
        passed = passed + csr_array(owner.T @ (edge.matrix @ owner))
    given_away = np.abs(np.asarray(passed @ np.ones(n)))
    told = given_away > ROUNDING * abs(passed).max(axis=1).toarray().ravel()
    told[space.body[~problem.free]] = True
    count, part = connected_components(passed, directed=False)
    known = np.zeros(count, dtype=bool)
    known[part[told]] = True
    return np.flatnonzero(~known[part])
