"""Published cases: a folder of scene, formulation, expected values, tolerances and versions."""

from __future__ import annotations

import hashlib
import json
import shutil
import tomllib
from collections.abc import Sequence
from pathlib import Path

from pydantic import Field

from nmm.errors import NmmError
from nmm.formulation import Formulation, as_tables, read_formulation
from nmm.results.versions import installed_versions
from nmm.scene import read_scene
from nmm.scene.document import parse, read_text
from nmm.scene.fields import Frozen, Number, Prose, Text
from nmm.stepping.run import run
from nmm.study.cases.quantities import check_quantity_name, quantity
from nmm.verification.base import Case, Check, Checks

SCENE, FORMULATION, EXPECTED = "scene.toml", "formulation.toml", "expected.toml"


class Value(Frozen):
    """One expected value."""

    quantity: Text = Field(description="the name of a quantity", examples=["failure_load"])
    value: Number = Field(description="a number in SI", examples=[1.0])
    tolerance: Number = Field(ge=0, description="a relative tolerance, >= 0", examples=[1e-6])
    source: Prose = Field(default="", description="where the value comes from")


class Expected(Frozen):
    """What a published case came to, and with what."""

    title: Text = Field(default="", description="a title")
    source: Prose = Field(default="", description="who published it, and where")
    values: tuple[Value, ...] = Field(min_length=1, description="at least one table [[values]]")
    versions: dict[Text, Text] = Field(default={}, description="a table [versions]")
    scene_hash: Text = Field(default="", description="the hash of the scene file")
    formulation_hash: Text = Field(default="", description="the hash of the formulation file")


class PublishedCase(Case):
    """A case folder as a benchmark of its own.

    Parameters
    ----------
    folder
        Holds ``scene.toml``, ``expected.toml`` and, if the scene's own is not meant,
        ``formulation.toml``.
    """

    formulations = ("as published",)

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        text = read_text(folder / EXPECTED, NmmError)
        self.expected = parse(text, Expected, str(folder / EXPECTED), NmmError)[0]
        # Read per folder where other benchmarks have them per class.
        self.__dict__.update(
            name=folder.resolve().name, title=self.expected.title, source=self.expected.source
        )

    def checks(self, formulation: str) -> Checks:
        """Run the folder's scene under its formulation and compare every value."""
        path = self.folder / FORMULATION
        self._unchanged("scene", self.folder / SCENE, self.expected.scene_hash)
        if path.exists():
            self._unchanged("formulation", path, self.expected.formulation_hash)
        scene = read_scene(self.folder / SCENE)
        chosen = read_formulation(path) if path.exists() else scene.formulation or Formulation()
        done = run(scene, chosen)
        return {
            item.quantity: Check(
                quantity(done, item.quantity), item.value, item.tolerance, item.source
            )
            for item in self.expected.values
        }

    @property
    def remarks(self) -> list[str]:
        """Libraries whose version is not the one it was published with."""
        here = installed_versions()
        return [
            f"published with {name} {version}, this is {here.get(name, 'not installed')}"
            for name, version in self.expected.versions.items()
            if here.get(name) != version
        ]

    def _unchanged(self, what: str, path: Path, said: str) -> None:
        found = content_hash(path)
        if said and said != found:
            raise NmmError(
                f"{self.folder / EXPECTED}: {what}_hash: {said[:12]}, but {path.name} has "
                f"{found[:12]}: expected the {what} that was published: undo the change, or "
                "publish the folder again"
            )


def content_hash(path: Path) -> str:
    """SHA-256 of what a TOML file says, whatever its order and comments.

    It is taken of the file and not of what is read from it, so that a later version, which knows
    more keys, still finds the file unchanged.
    """
    content = tomllib.loads(read_text(path, NmmError))
    text = json.dumps(content, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def is_published(folder: Path) -> bool:
    """Whether a folder is a published case."""
    return (folder / EXPECTED).is_file()


def publish(
    scene_file: Path,
    formulation_file: Path | None,
    quantities: Sequence[str],
    tolerance: float,
    out: Path,
    source: str = "",
) -> Path:
    """Run a scene and write the folder that others reproduce it from.

    Raises
    ------
    NmmError
        When the folder holds something already, or the run gave no value.
    """
    import tomli_w

    if out.exists() and any(out.iterdir()):
        raise NmmError(f"{out}: holds something: expected a new folder: choose another name")
    scene = read_scene(scene_file)
    chosen = (
        read_formulation(formulation_file)
        if formulation_file
        else scene.formulation or Formulation()
    )
    for name in quantities:
        check_quantity_name(scene, name)
    done = run(scene, chosen)
    said = {item.quantity: item.source for item in scene.references}
    values = [
        {
            "quantity": name,
            "value": quantity(done, name),
            "tolerance": tolerance,
            "source": f"this run; the scene's reference is {said[name]}"
            if name in said
            else "this run",
        }
        for name in quantities
    ]
    lost = [item["quantity"] for item in values if item["value"] != item["value"]]
    if lost:
        raise NmmError(f"quantity {lost[0]}: the run has none ({done.summary.sentence})")
    out.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(scene_file, out / SCENE)
    method = as_tables(chosen)
    (out / FORMULATION).write_text(tomli_w.dumps(method), encoding="utf-8")
    expected = {
        "title": scene.title,
        "source": source,
        "scene_hash": content_hash(out / SCENE),
        "formulation_hash": content_hash(out / FORMULATION),
        "values": values,
        "versions": installed_versions(),
    }
    (out / EXPECTED).write_text(tomli_w.dumps(expected), encoding="utf-8")
    return out
