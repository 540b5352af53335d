"""Sparse arrays of scipy, which are imported as the first is made.

They take as long to import as numpy. What checks a scene of blocks makes none, and annotations
name them only.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from scipy.sparse import (
        bsr_array,
        coo_array,
        csc_array,
        csr_array,
        diags_array,
        eye_array,
        hstack,
        kron,
        vstack,
    )
else:

    class _Made:
        """A class or function of `scipy.sparse` by its name."""

        def __init__(self, name: str) -> None:
            self._name = name

        def __call__(self, *given: Any, **options: Any) -> Any:
            import scipy.sparse

            return getattr(scipy.sparse, self._name)(*given, **options)

        def __or__(self, other: Any) -> Any:
            """Return the union of an annotation."""
            return Any

        __ror__ = __or__

    bsr_array, coo_array = _Made("bsr_array"), _Made("coo_array")
    csc_array, csr_array = _Made("csc_array"), _Made("csr_array")
    diags_array, eye_array = _Made("diags_array"), _Made("eye_array")
    hstack, kron, vstack = _Made("hstack"), _Made("kron"), _Made("vstack")

__all__ = [
    "bsr_array",
    "coo_array",
    "csc_array",
    "csr_array",
    "diags_array",
    "eye_array",
    "hstack",
    "kron",
    "vstack",
]
