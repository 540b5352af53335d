"""Sound files of scenes and formulations, from which spoilt ones are made."""

import re
from pathlib import Path

from nmm.shipped import PACKAGE
from nmm.verification.hard.spoilt.sound_effects import EFFECTS
from nmm.verification.hard.spoilt.sound_texts import (
    COVERS,
    CRACKED,
    DYNAMIC,
    JOINTED,
    METHOD,
    NETS,
    STATIC,
)

OUTSIDE = re.compile(r'^\w+ = "\w+:\w+"|^file = ', re.MULTILINE)
"""Keys whose value is a module or a file beside the scene: refused before anything else is read."""


def minimal() -> dict[str, str]:
    """Return small scenes that have all tables between them, by name."""
    scenes = {
        **{"static": STATIC, "dynamic": DYNAMIC, "jointed": JOINTED},
        **{"cracked": CRACKED, "nets": NETS},
        **EFFECTS,
    }
    covers = {name: f"{STATIC}[formulation.cover]\n{text}" for name, text in COVERS.items()}
    return {**scenes, **covers}


def formulations() -> dict[str, str]:
    """Return formulation files by name: one of all tables, and complete ones of the examples."""
    return {"method": METHOD, **_examples(scenes=False)}


def examples() -> dict[str, str]:
    """Return the scene files of the examples that need no other file, by name."""
    return _examples(scenes=True)


def _examples(scenes: bool) -> dict[str, str]:
    folders = (PACKAGE / "examples", PACKAGE.parent / "examples")
    folder = next(one for one in folders if one.is_dir())
    found = {}
    for path in sorted(folder.rglob("*.toml")):
        text = path.read_text(encoding="utf-8")
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
