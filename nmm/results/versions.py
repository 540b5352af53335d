"""Versions of Python and of the libraries that a result can depend on."""

import platform
from contextlib import suppress
from functools import cache

PACKAGES = ("nmm-framework", "numpy", "scipy", "scikit-fem", "shapely", "numba")
# Those that change an answer by rounding where they are installed.
OPTIONAL = ("pymetis", "qdldl", "python-mumps")


def installed_versions() -> dict[str, str]:
    """Return the versions of Python and of the libraries that a result can depend on."""
    return dict(_installed_versions())


@cache
def _installed_versions() -> dict[str, str]:
    """Return them as read from the files of all packages, once."""
    from importlib import metadata  # a check asks for no versions

    found = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "not installed"
    for name in OPTIONAL:
        with suppress(metadata.PackageNotFoundError):
            found[name] = metadata.version(name)
    return found
