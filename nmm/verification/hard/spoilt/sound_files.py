"""Sound files of scenes and formulations, from which spoilt ones are made."""

import re
from pathlib import Path

from nmm.shipped import PACKAGE

FOLDER = Path(__file__).parent / "sound"
"""Small scenes, one table or more of every effect among them."""

OUTSIDE = re.compile(r'^\w+ = "\w+:\w+"|^file = ', re.MULTILINE)
"""Keys whose value is a module or a file beside the scene: refused before anything else is read."""


def minimal() -> dict[str, str]:
    """Return small scenes that have all tables between them, by name."""
    return {path.stem.replace("_", " "): _text(path) for path in sorted(FOLDER.glob("*.toml"))}


def formulations() -> dict[str, str]:
    """Return formulation files by name: one of all tables, and complete ones of the examples."""
    return {"method": _text(FOLDER.parent / "formulation.toml"), **_examples(scenes=False)}


def examples() -> dict[str, str]:
    """Return the scene files of the examples that need no other file, by name."""
    return _examples(scenes=True)


def _examples(scenes: bool) -> dict[str, str]:
    folders = (PACKAGE / "examples", PACKAGE.parent / "examples")
    folder = next(one for one in folders if one.is_dir())
    found = {}
    for path in sorted(folder.rglob("*.toml")):
        text = _text(path)
        is_scene = "plane =" in text
        is_formulation = "[cover]" in text and not is_scene
        if (is_scene if scenes else is_formulation) and _complete(text):
            found[_name(folder, path)] = text
    return found


def _complete(text: str) -> bool:
    """Whether a text needs no module, no file of numbers and no size that a study gives."""
    sized = "size =" in text or 'type = "block"' in text or "[cover]" not in text
    return sized and OUTSIDE.search(text) is None


def _name(folder: Path, path: Path) -> str:
    return path.relative_to(folder).with_suffix("").as_posix()


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8")
