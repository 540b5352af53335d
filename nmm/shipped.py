"""Files that come with nmm: the examples and the scene that `nmm new` starts from."""

from pathlib import Path

from nmm.errors import NmmError

PACKAGE = Path(__file__).resolve().parent


def example(name: str) -> Path:
    """Return the path of an example such as "kitoh_beam/kitoh_130.toml".

    A wheel holds the examples inside the package, a checkout beside it.

    Raises
    ------
    NmmError
        When neither has it.
    """
    for folder in (PACKAGE / "examples", PACKAGE.parent / "examples"):
        if (folder / name).is_file():
            return folder / name
    raise NmmError(
        f"example {name}: not found in {PACKAGE / 'examples'} or {PACKAGE.parent / 'examples'}: "
        "expected the examples that come with nmm: install nmm-framework again"
    )


def starter() -> str:
    """Return the text of the commented scene that `nmm new` writes."""
    return (PACKAGE / "starter.toml").read_text(encoding="utf-8")
