"""`nmm parts`: all that can be exchanged, from whom it comes, in a line each."""

from importlib import metadata
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from typer.testing import CliRunner

from nmm.catalogue import REGISTRIES, parts
from nmm.cli.app import app

EXAMPLES = Path(__file__).parents[3] / "examples"


def call(*words):
    return CliRunner().invoke(app, ["parts", *words])


def test_every_built_in_part_is_listed_with_a_description():
    found = parts()
    for one in REGISTRIES:
        listed = {item.name: item for item in found if item.kind == one.kind}
        assert set(listed) == set(one.table)
        for item in listed.values():
            # As the class itself says, which is not imported for the list.
            assert item.says == (one.load(item.name).__doc__ or "").partition("\n")[0]
            assert item.says


def test_words_choose_lines():
    lines = call("cover").stdout.splitlines()
    assert [line.split()[1] for line in lines if line.split()[0] == "cover"] == [
        "block", "sub_blocks", "triangles", "quads", "graded", "bspline", "mls"
    ]  # fmt: skip
    (line,) = call("cover", "bspline").stdout.splitlines()
    assert "built-in" in line
    assert "covers.mathematical.bspline" in line


def test_words_of_no_part_are_told():
    result = call("cover", "hexagon")
    assert result.exit_code == 1
    assert "expected words of a part" in result.output


def test_parts_of_ones_own_are_listed_once_their_module_is_allowed(monkeypatch):
    monkeypatch.chdir(EXAMPLES / "own_effect")
    assert "foundation:" not in call("effect").stdout
    (line,) = call("foundation:Winkler", "--allow-code", "foundation").stdout.splitlines()
    assert line.split()[:3] == ["effect", "foundation:Winkler", "own"]


def test_a_module_that_cannot_be_imported_is_told():
    result = call("--allow-code", "nothing_of_this_name")
    assert result.exit_code == 1
    assert "No module named 'nothing_of_this_name'" in result.output


@pytest.mark.parametrize("target", ["nmm.outputs.stresses:VonMises", "no_such_package.x:Y"])
def test_parts_of_installed_packages_are_listed(monkeypatch, target):
    def offered(group):
        return [EntryPoint("offered", target, group)] if group == "nmm.output" else []

    monkeypatch.setattr(metadata, "entry_points", offered)
    (one,) = [item for item in parts() if item.origin == "entry point"]
    assert (one.kind, one.name) == ("output", "offered")
    assert one.says == (
        "cannot be read: ModuleNotFoundError"
        if "no_such" in target
        else "Von Mises stress of each element (Pa), the stress across the plane with it."
    )
