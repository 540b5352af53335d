"""Names of exchangeable parts: built-ins from a table, a user's own as ``module:Name``.

A part's module is imported when a scene or formulation names it, never before.
"""

from dataclasses import dataclass, field
from difflib import get_close_matches
from importlib import import_module
from importlib.metadata import entry_points
from typing import Generic, TypeVar, cast

from nmm.errors import FormulationError

Part = TypeVar("Part")


@dataclass(frozen=True)
class Registry(Generic[Part]):
    """One kind of exchangeable part.

    Attributes
    ----------
    kind
        What the parts are, in words ("material law"); packages offer more under the entry point
        group ``nmm.<kind>``, blanks as underscores.
    table
        Built-in names and the ``module:Name`` they stand for.
    """

    kind: str
    table: dict[str, str] = field(default_factory=dict)

    def names(self) -> list[str]:
        """Return the built-in names."""
        return sorted(self.table)

    def load(self, name: str) -> Part:
        """Import the part called ``name``.

        Raises
        ------
        FormulationError
            When the name is not known or cannot be imported.
        """
        target = self.table.get(name) or self._installed().get(name) or name
        module, separator, attribute = target.partition(":")
        if not separator:
            near = get_close_matches(name, self.table, n=1)
            hint = f' (did you mean "{near[0]}"?)' if near else ""
            raise FormulationError(
                f'{self.kind}: "{name}": expected one of {", ".join(self.names())} or '
                f'"module:Name" of your own{hint}'
            )
        try:
            return cast(Part, getattr(import_module(module), attribute))
        except (ImportError, AttributeError) as fault:
            raise FormulationError(
                f'{self.kind}: "{name}": could not be imported ({fault}): check that the module '
                "is on the Python path and defines that name"
            ) from fault

    def _installed(self) -> dict[str, str]:
        return {
            entry.name: entry.value
            for entry in entry_points(group=f"nmm.{self.kind.replace(' ', '_')}")
        }
