"""Numerical manifold method in 2D: scenes, formulations and runs.

The names below are imported when they are first asked for, so that `import nmm` costs nothing.
"""

from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from nmm.errors import NmmError as NmmError
    from nmm.formulation import Formulation as Formulation
    from nmm.formulation import read_formulation as read_formulation
    from nmm.results import StoredRun as StoredRun
    from nmm.results import read_run as read_run
    from nmm.scene import Scene as Scene
    from nmm.scene import parse_scene as parse_scene
    from nmm.scene import read_scene as read_scene
    from nmm.stepping.resume import resume as resume
    from nmm.stepping.run import Run as Run
    from nmm.stepping.run import run as run

    __version__: str

_HOME = {
    "Formulation": "nmm.formulation",
    "NmmError": "nmm.errors",
    "Run": "nmm.stepping.run",
    "Scene": "nmm.scene",
    "StoredRun": "nmm.results",
    "parse_scene": "nmm.scene",
    "read_formulation": "nmm.formulation",
    "read_run": "nmm.results",
    "read_scene": "nmm.scene",
    "resume": "nmm.stepping.resume",
    "run": "nmm.stepping.run",
}

__all__ = [*_HOME, "__version__"]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return import_module("importlib.metadata").version("nmm-framework")
    if name not in _HOME:
        raise AttributeError(f"module 'nmm' has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def _refuse_foreign(name: str) -> None:
    """Stop when a package that nmm brings along is hidden by another one of the same name."""
    expected = Path(__file__).resolve().parents[1] / name / "__init__.py"
    spec = find_spec(name)
    found = spec.origin if spec is not None else None
    if found is None or Path(found).resolve() != expected:
        raise ImportError(
            f"the package {name!r} of nmm was expected at {expected.parent} but Python finds "
            f"{found or 'none'}: take that one off the Python path, or install nmm-framework in an "
            "environment of its own",
            name=name,
        )


for _name in ("covers", "integration"):
    _refuse_foreign(_name)
