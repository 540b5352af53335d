"""Sums over the axes of arrays without the choices of numpy's own functions.

A step makes dozens of them, of arrays of a few numbers in small scenes: what `numpy.einsum` and the
methods of arrays ask and look through first costs more than the sums.
"""

from collections.abc import Callable

import numpy as np
from numpy._core.multiarray import c_einsum

from integration.arrays import Floats

contract: Callable[..., Floats] = c_einsum
"""`numpy.einsum` without choices: ``contract("mij,mj->mi", matrices, vectors)``."""
some, every = np.logical_or.reduce, np.logical_and.reduce
"""`any` and `all` along the first axis: of vectors, what their methods say by three calls."""
largest, least = np.maximum.reduce, np.minimum.reduce
"""`max` and `min` of vectors, likewise."""
summed = np.add.reduce
"""`sum` of vectors, likewise."""
