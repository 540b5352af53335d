"""Names of exchangeable parts: built-ins from a table, a user's own as ``module:Name``.

A part's module is imported when a scene or formulation names it, never before; a user's own only by
the user's word (`nmm.trust`). What is found there must derive from the base of its kind before
anything of it is called.
"""

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, field, fields, is_dataclass, replace
from difflib import get_close_matches
from importlib import import_module
from inspect import isabstract
from pathlib import Path
from types import ModuleType
from typing import Any, Generic, TypeVar, cast

from nmm.errors import Fault, FormulationError, NmmError, shown
from nmm.trust import allowing, import_allowed
from nmm.trust import given as trust

Part = TypeVar("Part")

# What an option may be, by the annotation of its field; other annotations are left to the part.
READ = {
    "float": ((int, float), "a number"),
    "tuple[float, ...]": ((list, tuple), "a list of numbers"),
    "int": ((int,), "a whole number"),
    "str": ((str,), "a text"),
    "bool": ((bool,), "true or false"),
}
# Of numbers; infinity and what is not a number are beyond it.
LARGEST = 1e30
# Packages whose own modules need no word of the user's.
HOME = ("nmm", "covers")
ABOVE_ZERO = "above zero"


@dataclass(frozen=True)
class Registry(Generic[Part]):
    """One kind of exchangeable part.

    Attributes
    ----------
    kind
        What the parts are, in words ("material law"); packages offer more under the entry point
        group ``nmm.<kind>``, blanks as underscores.
    base
        The class that every part of the kind derives from.
    table
        Built-in names and the ``module:Name`` they stand for.
    """

    kind: str
    base: type[Any]
    table: dict[str, str] = field(default_factory=dict)

    def names(self) -> list[str]:
        """Return the built-in names."""
        return sorted(self.table)

    def load(self, name: str) -> Part:
        """Import the part called ``name``.

        Raises
        ------
        FormulationError
            When the name is not known, may not or cannot be imported, or is no part of this kind.
        """
        target = self.table.get(name) or self.installed().get(name) or name
        module, separator, attribute = target.partition(":")
        if not separator:
            known = sorted({*self.table, *self.installed()})
            near = get_close_matches(name, known, n=1)
            expected = " or ".join(
                [*([f"one of {', '.join(known)}"] if known else []), '"module:Name" of your own']
            )
            remedy = f'did you mean "{near[0]}"?' if near else "correct the name"
            raise FormulationError(Fault(self.kind, f'"{name}"', expected, remedy))
        found = getattr(self._module(name, module, own=target == name), attribute, None)
        self._refuse_other(name, found)
        return cast(Part, found)

    def load_said(self, name: str) -> Part:
        """Import the part that the user names, on a command line or in a program: it is allowed.

        It is looked for in the working folder too. What is there under the whole name is a file
        and no class: a pattern such as ``*`` on a command line is no word of the user's.

        Raises
        ------
        FormulationError
            As `load`.
        """
        module, own, _ = name.partition(":")
        if not own or name in self.table or Path(name).exists():
            return self.load(name)
        with allowing(module, folder=Path.cwd()):
            return self.load(name)

    def _module(self, name: str, module: str, own: bool) -> ModuleType:
        """Import the module of a part; one of the user's ``own`` only if it is allowed."""
        if own and module.partition(".")[0] not in HOME and module not in trust().modules:
            expected = "the name of a built-in part, or a module whose code you allow to run"
            remedy = f"if you trust {module}, add --allow-code {module}"
            raise FormulationError(Fault(self.kind, f'"{name}"', expected, remedy))
        try:
            return import_allowed(module) if own else import_module(module)
        except Exception as fault:  # the code of a module may raise anything
            expected = "a module that can be imported"
            why = f"{type(fault).__name__}: {' '.join(str(fault).split())}"
            remedy = f"{why}; put it beside the scene or on the Python path, or correct it"
            raise FormulationError(Fault(self.kind, f'"{name}"', expected, remedy)) from fault

    def _refuse_other(self, name: str, found: object) -> None:
        """Refuse what is no complete class of the kind; nothing of it has been called yet."""
        base = f"{self.base.__module__}.{self.base.__qualname__}"
        if not (isinstance(found, type) and issubclass(found, self.base)):
            expected, remedy = f"a subclass of {base}", "name the class as module:Class"
            raise FormulationError(Fault(self.kind, f'"{name}"', expected, remedy))
        if isabstract(found):
            missing = ", ".join(sorted(getattr(found, "__abstractmethods__", ())))
            expected, remedy = f"all methods of {base}", f"define {missing}"
            raise FormulationError(Fault(self.kind, f'"{name}"', expected, remedy))

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
            options = _nested(place, kind, options)
        try:
            return kind(**given, **options)
        except NmmError:
            raise
        except Exception as fault:  # the code of a part may raise anything
            text = ", ".join(options) or "no option"
            expected = "a part that can be made of them"
            why = f"{type(fault).__name__}: {' '.join(str(fault).split())}"
            raise FormulationError(Fault(place, text, expected, why)) from fault

    def installed(self) -> dict[str, str]:
        """Return the names that installed packages offer, and what they stand for."""
        from importlib import metadata  # which most scenes need not wait for

        return {
            entry.name: entry.value
            for entry in metadata.entry_points(group=f"nmm.{self.kind.replace(' ', '_')}")
        }


def above_zero(default: float) -> Any:
    """Return the field of an option that must be above zero."""
    return field(default=default, metadata={ABOVE_ZERO: True})


def _nested(place: str, kind: Any, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options with tables in them made into the dataclasses that are their defaults."""
    made = dict(options)
    for item in fields(kind):
        if item.name not in options or item.default_factory is MISSING:
            continue
        default, given = item.default_factory(), options[item.name]
        if not is_dataclass(default) or isinstance(given, type(default)):
            continue
        within = f"{place}: {item.name}"
        if not isinstance(given, Mapping):
            raise FormulationError(Fault(within, shown(given), "a table of options", "write one"))
        _check_options(within, type(default), given, {})
        made[item.name] = replace(cast(Any, default), **_nested(within, type(default), given))
    return made


def _check_options(
    place: str, kind: Any, options: Mapping[str, Any], given: Mapping[str, Any]
) -> None:
    """Refuse options that a part does not have, and values of another type than it wants."""
    known = {item.name: item for item in fields(kind) if item.init and item.name not in given}
    check_values(place, {name: item.type for name, item in known.items()}, options)
    for key, value in options.items():
        if known[key].metadata.get(ABOVE_ZERO) and not value > 0:
            raise FormulationError(
                Fault(f"{place}: {key}", shown(value), "a number > 0", "raise it")
            )


def check_values(place: str, known: Mapping[str, Any], options: Mapping[str, Any]) -> None:
    """Refuse options whose names are not among the ``known``, or whose values do not fit them.

    Parameters
    ----------
    place
        What the options belong to, for the error.
    known
        Annotation of each option.
    options
        As given.

    Raises
    ------
    FormulationError
        For the first that does not fit.
    """
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
        fits = isinstance(value, types) and (int not in types or is_number)
        if not fits or (is_number and not abs(value) <= LARGEST):
            raise FormulationError(Fault(f"{place}: {key}", shown(value), words, "correct it"))
