"""Names of exchangeable parts: built-ins from a table, a user's own as ``module:Name``.

A part's module is imported when a scene or formulation names it, never before.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from difflib import get_close_matches
from importlib import import_module
from importlib.metadata import entry_points
from typing import Any, Generic, TypeVar, cast

from nmm.errors import Fault, FormulationError

Part = TypeVar("Part")

# What an option may be, by the annotation of its field; other annotations are left to the part.
READ = {
    "float": ((int, float), "a number"),
    "int": ((int,), "a whole number"),
    "str": ((str,), "a text"),
    "bool": ((bool,), "true or false"),
}


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
            expected = f'one of {", ".join(self.names())} or "module:Name" of your own'
            remedy = f'did you mean "{near[0]}"?' if near else "correct the name"
            raise FormulationError(Fault(self.kind, f'"{name}"', expected, remedy))
        try:
            return cast(Part, getattr(import_module(module), attribute))
        except (ImportError, AttributeError) as fault:
            expected = "a name that can be imported"
            remedy = f"{fault}; put the module on the Python path, or correct the name"
            raise FormulationError(Fault(self.kind, f'"{name}"', expected, remedy)) from fault

    def make(self, name: str, options: Mapping[str, Any] | None = None, **given: Any) -> Any:
        """Return the part called ``name``, made of what is ``given`` and of a user's ``options``.

        Raises
        ------
        FormulationError
            When the name is not known, or the part refuses an option.
        """
        kind, options = cast(Any, self.load(name)), options or {}
        place = f'{self.kind} "{name}"'
        if is_dataclass(kind):
            _check_options(place, kind, options, given)
        try:
            return kind(**given, **options)
        except TypeError as fault:
            text = ", ".join(options) or "no option"
            expected = "a part that can be made of them"
            raise FormulationError(Fault(place, text, expected, str(fault))) from fault

    def _installed(self) -> dict[str, str]:
        return {
            entry.name: entry.value
            for entry in entry_points(group=f"nmm.{self.kind.replace(' ', '_')}")
        }


def _check_options(
    place: str, kind: Any, options: Mapping[str, Any], given: Mapping[str, Any]
) -> None:
    """Refuse options that a part does not have, and values of another type than it wants."""
    known = {item.name: item.type for item in fields(kind) if item.init and item.name not in given}
    for key, value in options.items():
        if key not in known:
            near = get_close_matches(key, known, n=1)
            remedy = f'did you mean "{near[0]}"?' if near else "correct or remove it"
            expected = f"one of {', '.join(known)}" if known else "no option"
            raise FormulationError(Fault(place, key, expected, remedy))
        hint = known[key]
        if value is None and str(hint).endswith("| None"):
            continue
        named = hint if isinstance(hint, str) else getattr(hint, "__name__", str(hint))
        types, words = READ.get(named.removesuffix(" | None"), ((object,), ""))
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if not isinstance(value, types) or (int in types and not is_number):
            raise FormulationError(Fault(f"{place}: {key}", repr(value), words, "correct it"))
