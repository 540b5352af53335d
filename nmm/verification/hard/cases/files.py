"""Scenes of hard cases as files."""

import re
from pathlib import Path

from nmm.verification.hard.cases.base import Document


def toml(scene: Document) -> str:
    """Return the text of a scene file; numbers are read back to the last digit."""
    import tomli_w

    return tomli_w.dumps(scene)


def write_scene(folder: Path, label: str, scene: Document, words: str) -> Path:
    """Write a scene with a comment that says what is wrong with it."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / (re.sub(r"[^a-zA-Z0-9.]+", "_", label).strip("_") + ".toml")
    comment = "".join(f"# {line}\n" for line in words.splitlines())
    path.write_text(comment + toml(scene))
    return path
