"""All parts that can be exchanged: their kinds and names, where they come from, what they are.

Built-in and installed parts are described from their text, without running it.
"""

import ast
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from inspect import getmembers, isabstract, isclass
from pathlib import Path
from typing import Any

from nmm.constraints.imposition import IMPOSITIONS
from nmm.contact.enforcement.base import ENFORCEMENTS
from nmm.controls.base import CONTROLS
from nmm.fracture.criteria.base import CRITERIA
from nmm.geometry.tessellation.cover_types import COVER_TYPES, LOCAL_FUNCTIONS
from nmm.integrators.base import INTEGRATORS
from nmm.interfaces.base import INTERFACE_LAWS
from nmm.interfaces.bond_slip import BOND_LAWS
from nmm.materials.base import MATERIAL_LAWS
from nmm.model.effects_table import EFFECTS
from nmm.outputs.base import OUTPUTS
from nmm.registry import Registry
from nmm.solvers.linear import SOLVERS
from nmm.splitting.strength import STRENGTHS
from nmm.trust import import_allowed

REGISTRIES: tuple[Registry[Any], ...] = (
    COVER_TYPES,
    LOCAL_FUNCTIONS,
    MATERIAL_LAWS,
    INTERFACE_LAWS,
    BOND_LAWS,
    ENFORCEMENTS,
    IMPOSITIONS,
    INTEGRATORS,
    SOLVERS,
    EFFECTS,
    OUTPUTS,
    CRITERIA,
    STRENGTHS,
    CONTROLS,
)


@dataclass(frozen=True)
class Listed:
    """One part.

    Attributes
    ----------
    kind, name
        What it is, and how files name it.
    origin
        "built-in", "entry point" or "own".
    module
        Where its class stands.
    says
        First line of its description.
    """

    kind: str
    name: str
    origin: str
    module: str
    says: str

    def __str__(self) -> str:
        return f"{self.kind}  {self.name}  {self.origin}  {self.module}  {self.says}"


def parts(own: Iterable[str] = ()) -> list[Listed]:
    """Return all parts, kind by kind, and those in modules of one's ``own`` that are allowed.

    Raises
    ------
    ImportError
        When one of these cannot be imported.
    """
    modules = [import_allowed(name) for name in own]
    found: list[Listed] = []
    for registry in REGISTRIES:
        for name, target in registry.table.items():
            found.append(_told(registry.kind, name, "built-in", target))
        for name, target in registry.installed().items():
            found.append(_told(registry.kind, name, "entry point", target))
        for module in modules:
            found += _own(registry, module)
    return found


def _told(kind: str, name: str, origin: str, target: str) -> Listed:
    module, _, attribute = target.partition(":")
    return Listed(kind, name, origin, module, _first_line(module, attribute))


def _first_line(module: str, attribute: str) -> str:
    """Return the first line of a class's description, read from the text of its module."""
    try:
        spec = find_spec(module)
        text = Path((spec and spec.origin) or "").read_text(encoding="utf-8")
        tree = ast.parse(text)
    except (ImportError, OSError, SyntaxError, UnicodeDecodeError, ValueError) as fault:
        return f"cannot be read: {type(fault).__name__}"
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef) and node.name == attribute:
            return (ast.get_docstring(node) or "").partition("\n")[0]
    return "" if attribute in text else f"{module} has no {attribute}"


def _own(registry: Registry[Any], module: Any) -> Iterator[Listed]:
    """Yield the complete classes of a kind that a module defines."""
    for name, kind in getmembers(module, isclass):
        if kind.__module__ != module.__name__ or isabstract(kind):
            continue
        if issubclass(kind, registry.base):
            says = (kind.__doc__ or "").partition("\n")[0]
            where = module.__name__
            yield Listed(registry.kind, f"{where}:{name}", "own", where, says)
