"""Functions that numba compiles when they are first called; what it makes is kept on disk.

The compiled functions stand in the rooms that use them.
"""

from nmm.compiled.kernel import Kernel, compiled, compiled_sums, place

__all__ = ["Kernel", "compiled", "compiled_sums", "place"]
