"""What the manual shows works as it stands there."""

import re
import sys
import types
from pathlib import Path

import numpy as np
import pytest

import nmm.testing
from nmm import parse_scene
from nmm.catalogue import REGISTRIES
from nmm.effects.base import Effect
from nmm.geometry import regions

ROOT = Path(__file__).resolve().parents[1]


def blocks(path, language):
    """Fenced blocks of one language in a page."""
    return re.findall(rf"^```{language}\n(.*?)^```", (ROOT / path).read_text(), re.M | re.S)


def test_the_first_scene_of_the_readme_is_sound():
    (text,) = blocks("README.md", "toml")
    assert len(regions(parse_scene(text))) == 2


def test_the_python_of_the_readme_runs(tmp_path, monkeypatch, capsys):
    (scene,) = blocks("README.md", "toml")
    (code,) = blocks("README.md", "python")
    monkeypatch.chdir(tmp_path)
    Path("slope.toml").write_text(scene.replace('"0.5 s"', '"5 ms"'))
    exec(code, {})
    assert "0.005" in capsys.readouterr().out
    assert Path("slope.png").stat().st_size > 10_000


def test_the_law_of_the_manual_acts_in_a_scene(tmp_path, monkeypatch):
    code = blocks("docs/extending.md", "python")[0]
    (material,) = (one for one in blocks("docs/extending.md", "toml") if "[materials" in one)
    (tmp_path / "orthotropic.py").write_text(code)
    monkeypatch.syspath_prepend(tmp_path)
    scene = parse_scene(
        'title = "board"\nplane = "stress"\n'
        + material
        + """
[[blocks]]
material = "wood"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "bottom"
segment = [[0, 0], [2, 0]]
fix = ["y"]
[[supports]]
name = "corner"
point = [0, 0]
fix = ["x"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 1], [0, 1]]
traction = [0, "1 MPa"]
[[monitors]]
name = "top"
point = [2, 1]
"""
    )
    import nmm

    with pytest.raises(nmm.NmmError, match="--allow-code orthotropic"):
        nmm.run(scene)
    uy = nmm.run(scene, allow_code=["orthotropic"]).history["monitor:top:uy"][-1]
    # stress / modulus along y x height; supports are springs stiffer than the block by 1e5 at least
    assert uy == pytest.approx(1e6 / (0.05 * 11e9) * 1.0, rel=1e-4)


def test_the_parts_of_the_manual_pass_their_checks(monkeypatch):
    """Each page block ends in its check, which raises where a part is wrong."""
    monkeypatch.chdir(ROOT)
    for folder in ("own_cover", "own_law"):
        monkeypatch.syspath_prepend(ROOT / "examples" / folder)
    checked, space = [], {"__name__": "manual"}
    monkeypatch.setitem(sys.modules, "manual", types.ModuleType("manual"))
    for code in blocks("docs/extending.md", "python"):
        if "SceneCase" not in code:
            exec(code, space)
            checked += re.findall(r"^(check_\w+)\(", code, re.M)
    page = (ROOT / "docs/extending.md").read_text()
    table = {name for name in re.findall(r"`(check_\w+)`", page) if f"{name}(lambda" not in page}
    assert set(checked) == table - {"check_effect", "check_moved_effect"}


def test_every_suite_is_in_the_manual():
    page = (ROOT / "docs/extending.md").read_text()
    assert all(name in page for name in nmm.testing.__all__)


def test_every_kind_of_part_has_a_suite_in_the_manual():
    page = (ROOT / "docs/extending.md").read_text()
    bases = re.findall(r"^\| [^|]+ \| `([\w.]+)` \|[^|]*\| `check_\w+`", page, re.M)
    named = {f"{one.base.__module__}.{one.base.__qualname__}" for one in REGISTRIES}
    # Covers of meshes and of blocks are named alike in files, and have a base and a suite each.
    assert named - {"covers.mathematical.base.CoverType"} <= set(bases)
    assert "covers.mathematical.base.Cover" in bases


def test_every_page_is_in_the_index():
    index = (ROOT / "docs/index.md").read_text()
    pages = {path.name for path in (ROOT / "docs").glob("*.md")} - {"index.md"}
    assert not [page for page in pages if f"({page})" not in index]


def test_every_hook_of_effects_is_in_the_manual():
    page = (ROOT / "docs/extending.md").read_text()
    hooks = {name for name in dir(Effect) if not name.startswith("_")} - {"from_setup"}
    assert not [hook for hook in hooks if f"`{hook}`" not in page]


def rooms(package):
    """Folders of a package that stand in it itself."""
    return {path.parent.name for path in (ROOT / package).glob("*/__init__.py")}


def test_every_room_is_in_the_plan_of_the_house():
    page = (ROOT / "docs/architecture.md").read_text()
    assert not [room for room in rooms("nmm") | rooms("covers") if f"`{room}`" not in page]


def test_every_room_is_on_the_way_of_a_scene():
    page = (ROOT / "docs/walk.md").read_text()
    paths = [f"{package}/{room}" for package in ("nmm", "covers") for room in rooms(package)]
    assert not [path for path in paths if path not in page]


def test_pages_of_keys_are_those_of_the_models_that_read_the_files(script):
    for name, text in script(ROOT / "docs/keys.py").pages().items():
        assert (ROOT / "docs" / name).read_text() == text, "write it anew: python docs/keys.py"


def test_the_keys_of_parts_name_all_that_are_built_in():
    from covers.mathematical.registry import COVERS
    from nmm.interfaces.base import INTERFACE_LAWS

    page = (ROOT / "docs/formulation.md").read_text() + (ROOT / "docs/scene.md").read_text()
    assert all(f'"{name}"' in page for name in [*COVERS, *INTERFACE_LAWS.table])


def test_the_benchmark_of_the_manual_is_one_class(tmp_path, monkeypatch, bar_text):
    (code,) = (one for one in blocks("docs/extending.md", "python") if "SceneCase" in one)
    tip = '[[monitors]]\nname = "tip"\npoint = [4, 0.5]\n'
    scene = bar_text(poisson=0.0, more=tip)
    (tmp_path / "tip_cases.py").write_text(code.replace('"""..."""', repr(scene)))
    monkeypatch.syspath_prepend(tmp_path)
    from nmm.verification import verify

    outcomes = verify(["tip_cases:Tip"])
    assert [one.formulation for one in outcomes] == ["dda", "manifold"]
    assert all(one.passed and one.checks for one in outcomes), [*outcomes[0].lines()]


@pytest.mark.parametrize(
    "page", ["README.md", *sorted(p.name for p in (ROOT / "docs").glob("*.md"))]
)
def test_links_of_a_page_lead_to_files(page):
    path = ROOT / page if page == "README.md" else ROOT / "docs" / page
    links = re.findall(r"\]\(([^)#:]+\.md)\)", path.read_text())
    missing = [link for link in links if not (path.parent / link).exists()]
    assert not missing


def test_every_column_of_a_run_is_in_the_manual():
    import nmm

    (scene,) = blocks("README.md", "toml")
    run = nmm.run(parse_scene(scene.replace('"0.5 s"', '"2 ms"')))
    text = (ROOT / "docs/results.md").read_text()
    columns = [name for name in run.history if ":" not in name]
    assert np.all([f"`{name}`" in text for name in columns]), columns
