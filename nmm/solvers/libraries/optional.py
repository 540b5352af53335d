"""Solvers of other packages, picked up where they are installed."""

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType

from nmm.errors import FormulationError


@dataclass(frozen=True)
class OptionalPackage:
    """A package that a solver or an ordering comes from.

    Attributes
    ----------
    module, package
        What is imported, and what is installed.
    """

    module: str
    package: str

    @property
    def installed(self) -> bool:
        """Whether it can be found; it is not imported."""
        return find_spec(self.module) is not None

    @property
    def loads(self) -> bool:
        """Whether it can be imported; one that is installed may be built for another NumPy."""
        try:
            import_module(self.module)
        except ImportError:
            return False
        return True

    def load(self, solver: str) -> ModuleType:
        """Import it for a solver.

        Raises
        ------
        FormulationError
            When it is not installed, or does not load.
        """
        try:
            return import_module(self.module)
        except ImportError as fault:
            why = "not installed" if not self.installed else f"does not load: {fault}"
            raise FormulationError(
                f'solver "{solver}": {why}: expected the package {self.package}: '
                'install it or choose "auto"'
            ) from fault


QDLDL = OptionalPackage("qdldl", "qdldl")
MUMPS = OptionalPackage("mumps", "python-mumps")
METIS = OptionalPackage("pymetis", "pymetis")
