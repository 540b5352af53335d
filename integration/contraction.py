"""Sums of products over the small axes of arrays, as `numpy.einsum` says them.

A step makes twenty of them, of arrays of a few numbers in small scenes: what numpy's own function
asks and looks through first costs more than the sums.
"""

from numpy._core.multiarray import c_einsum

contract = c_einsum
"""`numpy.einsum` without choices: ``contract("mij,mj->mi", matrices, vectors)``."""
