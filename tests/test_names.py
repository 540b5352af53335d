"""Names of modules, classes and methods that texts and imports give lead to what is there.

Files are read, not imported.
"""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from nmm.catalogue import REGISTRIES

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("nmm", "covers", "integration")
# At the start of code in a text; a part is `module:Class`, as files name it.
NAME = re.compile(rf"`((?:{'|'.join(PACKAGES)})(?:[.:]\w+)+)")
# Other packages offer parts under these.
GROUPS = {f"nmm.{one.kind.replace(' ', '_')}" for one in REGISTRIES}


def home(module: str) -> Path | None:
    """File of a module; None where there is none."""
    path = ROOT.joinpath(*module.split("."))
    files = path.with_name(f"{path.name}.py"), path / "__init__.py"
    return next((file for file in files if file.is_file()), None)


def bound(body: list[ast.stmt], types: bool) -> Iterator[tuple[str, list[str]]]:
    """Names that statements bind, and what each is or derives from.

    With ``types`` also those that only type checkers import.
    """
    for node in body:
        match node:
            case ast.If() if types or "TYPE_CHECKING" not in ast.unparse(node.test):
                yield from bound(node.body + node.orelse, types)
            case ast.ImportFrom():
                for one in node.names:
                    yield one.asname or one.name, [f"{node.module}.{one.name}"]
            case ast.ClassDef():
                yield node.name, [ast.unparse(base).partition("[")[0] for base in node.bases]
                inside = dict(bound(node.body, types)).keys() | given(node)
                yield from ((f"{node.name}.{name}", []) for name in inside)
            case ast.FunctionDef():
                yield node.name, []
            case ast.Assign() | ast.AnnAssign():
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                parts = (part for target in targets for part in ast.walk(target))
                yield from ((part.id, []) for part in parts if isinstance(part, ast.Name))


def given(kind: ast.ClassDef) -> set[str]:
    """Attributes that methods of a class give it."""
    parts = (part for part in ast.walk(kind) if isinstance(part, ast.Attribute))
    return {part.attr for part in parts if isinstance(part.ctx, ast.Store)}


@cache
def names_of(module: str) -> dict[str, list[str]]:
    """Names of a module, and what each is or derives from."""
    body = ast.parse(home(module).read_text()).body
    lazy = any(isinstance(one, ast.FunctionDef) and one.name == "__getattr__" for one in body)
    return dict(bound(body, types=lazy))


@cache
def exists(name: str) -> bool:
    """Whether a dotted name is a module of the packages, or an attribute of one or of a class."""
    if home(name):
        return True
    module = name.rpartition(".")[0]
    while module and not home(module):
        module = module.rpartition(".")[0]
    if not module:
        return False
    names, behind = names_of(module), name.removeprefix(f"{module}.")
    first, _, rest = behind.partition(".")
    found = [f"{module}.{one}" if one in names else one for one in names.get(first, [])]
    return behind in names or any(exists(f"{one}.{rest}") for one in found if rest)


def texts() -> Iterator[Path]:
    """All files that name parts of the packages in words."""
    yield from ROOT.glob("*.md")
    for folder in ("docs", "changelog.d", "examples"):
        yield from (ROOT / folder).rglob("*.md")
    for folder in (*PACKAGES, "tests", "benchmarks", "examples"):
        yield from (ROOT / folder).rglob("*.py")


def test_every_dotted_name_in_a_text_is_there():
    gone = [
        f"{file.relative_to(ROOT)}:{number}: {name}"
        for file in texts()
        for number, line in enumerate(file.read_text().splitlines(), start=1)
        for name in NAME.findall(line)
        if name not in GROUPS and not exists(name.replace(":", "."))
    ]
    assert not gone, "\n" + "\n".join(gone)


@pytest.mark.parametrize("folder", ["tests", "benchmarks", "examples", "docs"])
def test_every_name_that_is_imported_is_there(folder):
    """What mypy sees to in the packages."""
    gone = [
        f"{file.relative_to(ROOT)}:{node.lineno}: {node.module}.{one.name}"
        for file in (ROOT / folder).rglob("*.py")
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.ImportFrom) and str(node.module).split(".")[0] in PACKAGES
        for one in node.names
        if not exists(f"{node.module}.{one.name}")
    ]
    assert not gone, "\n" + "\n".join(gone)


@pytest.mark.parametrize(
    ("name", "there"),
    [
        ("nmm.materials.base.Law.update", True),
        ("nmm.materials.base.Law.nothing", False),
        ("nmm.materials.elastic.Elastic.swells", True),  # of its base, in another file
        ("nmm.materials.elastic.Elastic.nothing", False),
        ("nmm.Scene", True),  # imported when asked for
        ("nmm.Scenes", False),
        ("nmm.scene.actions.Reference", False),
        ("nmm.laws.base", False),
    ],
)
def test_a_name_is_looked_up_as_python_would(name, there):
    assert exists(name) == there
