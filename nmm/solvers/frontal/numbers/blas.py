"""Dense kernels of LAPACK and BLAS for compiled code, through scipy's own pointers.

Addresses are arguments of the compiled functions, so these can be kept on disk.
"""

from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Index, Ints

LETTERS, SCALARS = np.frombuffer(b"LNRTU", dtype=np.uint8), np.array([1.0, -1.0, 0.0])
ARGUMENTS = 5, 6, 8, 10, 11, 13
"""How many the kernels take."""
SINGLES = SCALARS.astype(np.float32)
Outside = tuple[Ints, npt.NDArray[np.uint8], Index, npt.NDArray[Any]]
"""Addresses of kernels, and room for the letters, sizes and numbers they take."""
Inside = tuple[Ints, Ints, Ints, Ints, Ints, Ints, npt.NDArray[Any], Index, bool]
"""A plan and the numbers of a factor on it, as solutions take them; whether pivots are inverted."""


@cache
def addresses(lapack: str, *blas: str) -> Ints:
    """Return the addresses of kernels by name, which compiled code takes as arguments."""
    from numba.extending import get_cython_function_address

    for arguments in ARGUMENTS:  # numba knows what is there before it begins to compile
        _caller(arguments)
    found = [get_cython_function_address("scipy.linalg.cython_lapack", lapack)]
    found += [get_cython_function_address("scipy.linalg.cython_blas", name) for name in blas]
    return np.array(found, dtype=np.int64)


def words(single: bool = False) -> tuple[npt.NDArray[np.uint8], Index, npt.NDArray[Any]]:
    """Arguments that LAPACK takes by address: letters, room for four integers, (1, -1, 0)."""
    return LETTERS, np.empty(4, dtype=np.int32), SINGLES if single else SCALARS


def __getattr__(name: str) -> Any:
    """Make ``call5``, which calls a function of five pointers, and the like, as numba asks."""
    if not (name.startswith("call") and name[4:].isdecimal()):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return _caller(int(name[4:]))


@cache
def _caller(count: int) -> Any:
    """Intrinsic ``call(address, (p_1, ..., p_count))`` of a C function that takes pointers."""
    from llvmlite import ir  # type: ignore[import-untyped]
    from numba import types
    from numba.extending import intrinsic

    def call(typing: Any, address: Any, pointers: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            byte = ir.IntType(8).as_pointer()
            kind = ir.FunctionType(ir.VoidType(), [byte] * count)
            function = builder.inttoptr(arguments[0], kind.as_pointer())
            values = [builder.extract_value(arguments[1], i) for i in range(count)]
            builder.call(function, [builder.inttoptr(value, byte) for value in values])
            return context.get_dummy_value()

        return types.void(address, pointers), build

    return intrinsic(call)
