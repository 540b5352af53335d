"""Random numbers of libraries that take numpy's global ones: the same in every run."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np


@contextmanager
def same_draws() -> Iterator[None]:
    """Let the global random numbers begin anew, and go on after it as if nothing was drawn.

    `scipy.sparse.linalg.onenormest` starts from random signs and has no argument for them.
    """
    before = np.random.get_state()  # noqa: NPY002
    np.random.seed(0)  # noqa: NPY002
    try:
        yield
    finally:
        np.random.set_state(before)  # noqa: NPY002
