"""Whose code may run: parts of one's own are imported only by the user's word, module by module.

Scenes, formulations, studies, published cases and run folders are data and may come from anybody.
A name such as ``module:Class`` in them imports nothing until the user has named the module: by
``--allow-code MODULE``, ``nmm.run(..., allow_code=["module"])`` or `allowing`. The folder of a
scene is searched while such a module is imported and at no other time, so that no file in it can
stand in for an optional library of ours.
"""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from importlib import import_module, invalidate_caches
from pathlib import Path
from types import ModuleType


@dataclass(frozen=True)
class UserTrust:
    """What the user has said.

    Attributes
    ----------
    modules
        Names of modules that may be imported.
    folders
        Where these are looked for, behind all that is installed.
    """

    modules: frozenset[str] = frozenset()
    folders: tuple[str, ...] = ()


NOBODY = UserTrust()
_GIVEN: ContextVar[UserTrust] = ContextVar("trust", default=NOBODY)


def given() -> UserTrust:
    """Return what may be imported now."""
    return _GIVEN.get()


@contextmanager
def allowing(*modules: str, folder: str | Path | None = None) -> Iterator[None]:
    """Let parts of the named modules be imported within a ``with`` block.

    Parameters
    ----------
    modules
        Names as they stand before the colon of ``module:Class``, each in full.
    folder
        Where they may lie besides the Python path.
    """
    now = _GIVEN.get()
    own = () if folder is None else (str(Path(folder).resolve()),)
    token = _GIVEN.set(UserTrust(now.modules | set(modules), (*now.folders, *own)))
    try:
        yield
    finally:
        _GIVEN.reset(token)


def beside(place: str, modules: Iterable[str]) -> Path | None:
    """Return the folder of a file called ``place`` where there is one and modules are allowed."""
    file = Path(place)
    return file.resolve().parent if any(True for _ in modules) and file.is_file() else None


def import_allowed(module: str) -> ModuleType:
    """Import a module that the user has named.

    Raises
    ------
    ImportError
        When it cannot be found, or another one of its name is loaded from elsewhere.
    """
    folders = [folder for folder in _GIVEN.get().folders if folder not in sys.path]
    sys.path.extend(folders)
    try:
        if folders:
            invalidate_caches()
        found = import_module(module)
    finally:
        for folder in folders:
            sys.path.remove(folder)
    _refuse_namesake(module, found, folders)
    return found


# Files that modules were imported from besides the Python path.
_BROUGHT: dict[str, Path] = {}


def _refuse_namesake(module: str, found: ModuleType, folders: list[str]) -> None:
    """Refuse a module that an earlier scene brought, where this scene brings one of its name."""
    loaded = Path(getattr(found, "__file__", None) or "").resolve()
    places = [Path(folder, *module.split(".")) for folder in folders]
    files = [(place.parent / f"{place.name}.py").resolve() for place in places]
    if loaded in files:
        _BROUGHT[module] = loaded
    elif module in _BROUGHT and (own := [file for file in files if file.is_file()]):
        raise ImportError(
            f"{loaded} is loaded already under this name and {own[0]} is another one: rename it, "
            "or run it in a process of its own"
        )
