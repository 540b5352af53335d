"""The plan of the house, held by tests: who may import whom, and what stays light."""

import ast
import subprocess
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from nmm.catalogue import REGISTRIES
from nmm.model import effects_table
from nmm.verification.hard.running.registry import HARD
from nmm.verification.registry import CASES

ROOT = Path(__file__).resolve().parents[1]

# A package may import itself, what stands left of it, and the libraries named here.
PACKAGES = ("integration", "covers", "nmm")
LIBRARIES = {
    "integration": {"numpy", "scipy", "shapely", "skfem"},
    "covers": {"numpy", "scipy", "shapely", "skfem"},
}

# A room of nmm may import itself and the rooms above it in this list. `solvers` and `assembly`
# stand above `contact` and `effects`, which work on the model of bodies and unknowns and are handed
# a linear solver; `results` stands above `stepping`, which hands its frames to a sink.
ROOMS = (
    "errors",
    "frozen",
    "progress",
    "trust",
    "registry",
    "quantity",
    "capacity",
    "plain_file",
    "compiled",
    "shipped",
    "scene",
    "geometry",
    "materials",
    "interfaces",
    "integrators",
    "solvers",
    "assembly",
    "controls",
    "contact",
    "effects",
    "constraints",
    "diffusion",
    "heat",
    "water",
    "fracture",
    "splitting",
    "outputs",
    "results",
    "model",
    "catalogue",
    "stepping",
    "plots",
    "study",
    "verification",
    "cli",
    "testing",
)
# Modules that belong to a room but for their place.
IN_ROOM = {"formulation": "scene"}  # formulation files are read by the reader of scenes
# The public face `nmm/__init__.py` imports any room, lazily; these rooms may use it.
MAY_USE_THE_FACE = {
    "study",
    "verification",
    "cli",
    "testing",
}
ONLY_PLOTS = {"matplotlib"}


# Built-in effects, wherever they stand; what several of them share is in none of these modules.
EFFECTS = {place.partition(":")[0] for place in effects_table.EFFECTS.table.values()}


class Import(NamedTuple):
    importer: str  # dotted module name
    imported: str  # dotted module name, or module.name for `from module import name`
    place: str  # file:line


def module_name(path: Path, root: Path) -> str:
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def statements(body: Iterable[ast.AST], typed: bool = False) -> Iterator[tuple[ast.AST, bool]]:
    """All statements, and whether only type checkers read them."""
    for node in body:
        for_types = typed or (isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test))
        yield node, for_types
        for part in ("body", "orelse", "finalbody", "handlers", "cases"):
            yield from statements(getattr(node, part, ()), for_types)


@cache
def written_imports(path: Path, root: Path) -> tuple[tuple[Import, bool], ...]:
    """Imports of a file, and whether only type checkers read them."""
    importer, found = module_name(path, root), []
    package = importer if path.name == "__init__.py" else importer.rpartition(".")[0]
    for node, for_types in statements(ast.parse(path.read_text(), filename=str(path)).body):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                above = package.split(".")[: len(package.split(".")) - node.level + 1]
                base = ".".join([*above, *filter(None, [base])])
            names = [f"{base}.{alias.name}" for alias in node.names]
        else:
            continue
        place = f"{path.relative_to(root)}:{node.lineno}"
        found += [(Import(importer, name, place), for_types) for name in names]
    return tuple(found)


def imports_of(path: Path, root: Path, types: bool = True) -> Iterator[Import]:
    """Imports of a file, those for ``types`` alone among them or not."""
    return (found for found, for_types in written_imports(path, root) if types or not for_types)


@cache
def all_imports(root: Path) -> list[Import]:
    files = [path for package in PACKAGES for path in sorted((root / package).rglob("*.py"))]
    return [found for path in files for found in imports_of(path, root)]


def room_of(module: str) -> str:
    name = module.split(".")[1] if "." in module else "__init__"
    return IN_ROOM.get(name, name)


def fault_between_packages(found: Import) -> str | None:
    here, there = found.importer.split(".")[0], found.imported.split(".")[0]
    if there in PACKAGES:
        if PACKAGES.index(there) > PACKAGES.index(here):
            return f"{here} imports {there}: imports point integration <- covers <- nmm"
        return None
    allowed = LIBRARIES.get(here)
    if allowed is None or there in allowed or there in sys.stdlib_module_names:
        return None
    return f"{here} imports {there}: it may import {', '.join(sorted(allowed))} only"


def fault_between_rooms(found: Import) -> str | None:
    if not (found.importer.startswith("nmm.") and found.imported.split(".")[0] == "nmm"):
        return None
    here, there = room_of(found.importer), room_of(found.imported)
    if here not in ROOMS:
        return f"nmm.{here} has no place in ROOMS of {Path(__file__).name}: give it one"
    if there not in ROOMS:
        if here in MAY_USE_THE_FACE:
            return None
        return f"nmm.{here} imports the public face ({found.imported}): import the room itself"
    if ROOMS.index(there) > ROOMS.index(here):
        return f"nmm.{here} imports nmm.{there}: rooms import upwards in ROOMS only"
    return None


def fault_between_effects(found: Import) -> str | None:
    # What is imported is a module, or a name of it.
    there = {found.imported, found.imported.rpartition(".")[0]} & EFFECTS - {found.importer}
    if found.importer in EFFECTS and there:
        return f"{found.importer} imports {there.pop()}: effects never import one another"
    return None


def fault_of_drawing(found: Import) -> str | None:
    library = found.imported.split(".")[0]
    if library in ONLY_PLOTS and not found.importer.startswith("nmm.plots"):
        return f"{found.importer} imports {library}: only nmm.plots draws"
    return None


def test_the_effects_are_found():
    known = {found.importer for found in all_imports(ROOT)}
    assert {"nmm.effects.gravity", "nmm.effects.members.bars", "nmm.heat.temperature"} <= EFFECTS
    assert known >= EFFECTS


RULES = [fault_between_packages, fault_between_rooms, fault_between_effects, fault_of_drawing]


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_imports_point_one_way(rule):
    faults = [f"{found.place}: {fault}" for found in all_imports(ROOT) if (fault := rule(found))]
    assert not faults, "\n" + "\n".join(dict.fromkeys(faults))


@pytest.mark.parametrize(
    ("path", "line", "rule"),
    [
        ("integration/a.py", "import covers.approximation.manifold", fault_between_packages),
        ("integration/a.py", "import matplotlib.pyplot", fault_between_packages),
        ("covers/a.py", "def f():\n    from nmm.scene import Scene", fault_between_packages),
        ("nmm/scene/a.py", "from nmm.contact import search", fault_between_rooms),
        ("nmm/scene/a.py", "from ..contact import search", fault_between_rooms),
        ("nmm/results/a.py", "from nmm.stepping.run import Run", fault_between_rooms),
        ("nmm/stepping/a.py", "from nmm import run", fault_between_rooms),
        ("nmm/attic/a.py", "from nmm.scene import Scene", fault_between_rooms),
        ("nmm/effects/gravity.py", "from nmm.effects import inertia", fault_between_effects),
        ("nmm/effects/gravity.py", "from . import inertia", fault_between_effects),
        ("nmm/results/a.py", "import matplotlib", fault_of_drawing),
    ],
)
def test_a_wrong_import_is_named_by_file_and_line(tmp_path, path, line, rule):
    file = tmp_path / path
    file.parent.mkdir(parents=True)
    file.write_text("import math\n" + line + "\n")
    faulty = [found for found in imports_of(file, tmp_path) if rule(found)]
    assert [found.place for found in faulty] == [f"{path}:{2 + line.count(chr(10))}"]


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ("nmm/effects/gravity.py", "from nmm.effects.base import Effect"),
        ("nmm/effects/gravity.py", "from nmm.materials.base import Law"),
        ("nmm/cli/app.py", "from nmm import run"),
        ("nmm/plots/a.py", "import matplotlib.pyplot as plt"),
        ("covers/a.py", "from integration.polygons import Polygons"),
        ("integration/a.py", "from skfem.quadrature import get_quadrature"),
    ],
)
def test_a_right_import_passes(tmp_path, path, line):
    file = tmp_path / path
    file.parent.mkdir(parents=True)
    file.write_text(line + "\n")
    assert not [
        rule(found) for found in imports_of(file, tmp_path) for rule in RULES if rule(found)
    ]


@cache
def pairs_of_modules(root: Path, types: bool) -> set[tuple[str, str]]:
    """Pairs of which the first imports the second: at once, when needed, or for ``types`` alone."""
    files = [path for package in PACKAGES for path in (root / package).rglob("*.py")]
    known = {module_name(path, root) for path in files}
    pairs = set()
    for path in files:
        for found in imports_of(path, root, types):
            there = found.imported
            while there and there not in known:
                there = there.rpartition(".")[0]
            if there and there != found.importer:
                pairs.add((found.importer, there))
    return pairs


def circles(pairs: set[tuple[str, str]]) -> list[list[str]]:
    names = sorted({name for pair in pairs for name in pair})
    number = {name: at for at, name in enumerate(names)}
    ones = np.ones(len(pairs))
    at = ([number[a] for a, _ in pairs], [number[b] for _, b in pairs])
    graph = coo_array((ones, at), shape=(len(names),) * 2)
    count, label = connected_components(graph, connection="strong")
    groups: list[list[str]] = [[] for _ in range(count)]
    for name, group in zip(names, label, strict=True):
        groups[group].append(name)
    return [group for group in groups if len(group) > 1]


def folder(module: str) -> str:
    return module if (ROOT / module.replace(".", "/")).is_dir() else module.rpartition(".")[0]


def test_no_files_import_each_other_in_a_circle():
    """Nor by imports when they are needed, or for type checkers alone."""
    assert not circles(pairs_of_modules(ROOT, types=True))


def test_a_circle_by_imports_for_types_is_found(tmp_path):
    (tmp_path / "nmm").mkdir()
    types = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from nmm.b import B\n"
    (tmp_path / "nmm/a.py").write_text(types)
    (tmp_path / "nmm/b.py").write_text("def f():\n    import nmm.a\n")
    assert circles(pairs_of_modules(tmp_path, types=True)) == [["nmm.a", "nmm.b"]]
    assert not circles(pairs_of_modules(tmp_path, types=False))


def test_no_folders_import_each_other_in_a_circle():
    """A folder and one inside it count as one: the outer draws on the inner."""
    pairs = {(folder(a), folder(b)) for a, b in pairs_of_modules(ROOT, types=False)}
    apart = {(a, b) for a, b in pairs if not f"{a}.".startswith(f"{b}.")}
    assert not circles({(a, b) for a, b in apart if not f"{b}.".startswith(f"{a}.")})


FOLDERS = sorted(
    path.parent.relative_to(ROOT).as_posix()
    for package in PACKAGES
    for path in (ROOT / package).rglob("__init__.py")
)


@pytest.mark.parametrize("room", FOLDERS)
def test_a_room_says_in_a_sentence_what_is_in_it(room):
    says = ast.get_docstring(ast.parse((ROOT / room / "__init__.py").read_text())) or ""
    assert says.split("\n")[0].endswith((".", ":"))
    assert len(says.split("\n")[0]) > 20


def homes_of_public_classes(root: Path) -> dict[str, list[str]]:
    """Files that define each public class."""
    homes: dict[str, list[str]] = {}
    for path in (path for package in PACKAGES for path in sorted((root / package).rglob("*.py"))):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                homes.setdefault(node.name, []).append(path.relative_to(root).as_posix())
    return homes


def test_no_two_public_classes_of_all_rooms_share_a_name():
    """A table of a file that is named like what it describes ends in `Table`."""
    homes = homes_of_public_classes(ROOT)
    twice = {name: files for name, files in homes.items() if len(files) > 1}
    assert not twice


def numbers_of(path: Path) -> Iterator[tuple[str, str]]:
    """Names in capitals that a file gives values, and the values as they are written."""
    for node in ast.parse(path.read_text()).body:
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        for target in targets:
            names, values = [target], [node.value]
            if isinstance(target, ast.Tuple):
                several = isinstance(node.value, ast.Tuple)
                names = target.elts
                values = node.value.elts if several else [node.value] * len(names)
            for name, value in zip(names, values, strict=True):
                if isinstance(name, ast.Name) and name.id.isupper():
                    yield name.id, ast.unparse(value)


# Rooms whose numbers steer a solution, each of a subject in which a number has one meaning.
STEERED = (
    *("covers", "integration"),
    *(f"nmm/{room}" for room in ROOMS[ROOMS.index("scene") : ROOMS.index("plots")]),
)


@pytest.mark.parametrize("package", [room for room in STEERED if (ROOT / room).is_dir()])
def test_a_number_means_the_same_in_all_rooms_of(package):
    found: dict[str, dict[str, str]] = {}
    for path in sorted((ROOT / package).rglob("*.py")):
        for name, value in numbers_of(path):
            found.setdefault(name, {})[path.relative_to(ROOT).as_posix()] = value
    twice = {name: homes for name, homes in found.items() if len({*homes.values()}) > 1}
    assert not twice, "one name, several meanings: " + str(twice)


def declared(kind: ast.ClassDef, known: dict[str, ast.ClassDef]) -> set[str]:
    """Names that a class or a base of it describes: methods with a docstring, and attributes."""
    names = {
        part.name if isinstance(part, ast.FunctionDef) else ast.unparse(part.target)
        for part in kind.body
        if (isinstance(part, ast.FunctionDef) and ast.get_docstring(part))
        or isinstance(part, ast.AnnAssign)
    }
    bases = (ast.unparse(base).partition("[")[0].rpartition(".")[2] for base in kind.bases)
    return names.union(*(declared(known[base], known) for base in bases if base in known))


def test_every_public_method_is_described_where_it_is_declared():
    """Methods that override another need say no more: no two public classes share a name."""
    known = {
        part.name: part
        for package in PACKAGES
        for path in (ROOT / package).rglob("*.py")
        for part in ast.parse(path.read_text()).body
        if isinstance(part, ast.ClassDef)
    }
    missing = [
        f"{name}.{part.name}"
        for name, kind in known.items()
        for part in kind.body
        if isinstance(part, ast.FunctionDef)
        and not name.startswith("_")
        and not part.name.startswith("_")
        and part.name not in declared(kind, known)
        and not {"overload", f"{part.name}.setter"} & {ast.unparse(d) for d in part.decorator_list}
    ]
    assert not missing


@pytest.mark.parametrize("room", FOLDERS)
def test_a_room_holds_no_more_files_than_a_reader_can_survey(room):
    files = [path for path in (ROOT / room).glob("*.py") if path.name != "__init__.py"]
    assert len(files) <= 15


def test_tests_stand_in_the_rooms_that_they_test():
    """So that a fault is located by where it shows."""
    tests = ROOT / "tests"
    folders = {path.parent.relative_to(tests) for path in tests.rglob("test_*.py")}
    rooms = {folder.parts for folder in folders if len(folder.parts) > 1}
    homes = {(room[0].removeprefix("test_"), *room[1:]) for room in rooms}
    assert homes
    assert not [home for home in homes if not ROOT.joinpath(*home).is_dir()]


HEAVY = ("scipy", "matplotlib", "skfem", "pint", "numba", "shapely", "numpy")


def all_modules_after(code: str) -> set[str]:
    answer = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
    )
    return set(answer.stdout.split())


def modules_after(code: str) -> set[str]:
    return {name.split(".")[0] for name in all_modules_after(code)}


def test_help_imports_nothing_heavy():
    code = (
        "from typer.testing import CliRunner; from nmm.cli.app import app\n"
        "assert CliRunner().invoke(app, ['--help']).exit_code == 0"
    )
    assert not modules_after(code) & set(HEAVY)


SELDOM = ("special", "linalg", "spatial", "optimize", "sparse.linalg", "sparse.csgraph")


def test_preparing_blocks_in_contact_imports_no_compiler_and_no_part_of_scipy_not_called():
    code = (
        "import nmm; from nmm.stepping.prepare import prepare\n"
        "scene = nmm.read_scene('examples/incline/slide.toml')\n"
        "prepare(scene, scene.formulation).identity()\n"
        "print()"
    )
    assert not all_modules_after(code) & {"numba", *(f"scipy.{name}" for name in SELDOM)}


NOT_TO_CHECK = (
    "contact.candidates.candidates",
    "contact.solution.geometry",
    "contact.solution.mixed_bonds",
    "contact.bonds.tied_step",
    "stepping.simulation",
    "stepping.step.stepper",
    "stepping.bounds",
    "plots",
    "study",
)


@pytest.mark.parametrize("scene", ["incline/slide.toml", "stack/stack.toml"])
def test_a_check_of_blocks_imports_neither_sparse_matrices_nor_the_step_loop(scene):
    code = (
        "from typer.testing import CliRunner; from nmm.cli.app import app\n"
        f"asked = ['check', 'examples/{scene}']\n"
        "assert CliRunner().invoke(app, asked).exit_code == 0"
    )
    found = all_modules_after(code)
    assert not found & {"numba", "scipy"}
    assert not found & {f"nmm.{name}" for name in NOT_TO_CHECK}


def test_the_public_face_is_lazy():
    assert not modules_after("import nmm; nmm.__version__") & {*HEAVY, "pydantic", "typer"}


def test_a_foreign_package_of_the_same_name_is_named(tmp_path):
    (tmp_path / "covers").mkdir()
    (tmp_path / "covers/__init__.py").write_text("")
    answer = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import nmm"],
        capture_output=True,
        text=True,
    )
    last = answer.stderr.splitlines()[-1]
    assert last.startswith("ImportError: the package 'covers' of nmm was expected at")
    assert str(tmp_path / "covers") in last


def test_every_public_name_is_there():
    code = "import nmm\nfor name in nmm.__all__: getattr(nmm, name)"
    modules_after(code)


@pytest.mark.parametrize("registry", [*REGISTRIES, CASES, HARD], ids=lambda one: one.kind)
def test_every_name_of_a_registry_leads_to_its_part(registry):
    assert all(registry.load(name) for name in registry.table)
