"""One thread for linear algebra, so that processor seconds can be compared."""

import os

ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def one_thread() -> None:
    """Ask the linear algebra for one thread; of use before numpy is first imported."""
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")
