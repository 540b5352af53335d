"""The formulation: how a scene is approximated; no physics here.

Its tables stand in `nmm.scene.methods`.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

from pydantic import Field, PrivateAttr

from nmm.errors import FormulationError
from nmm.scene.document import parse, read_text
from nmm.scene.faults import Source
from nmm.scene.fields import Count, Frozen, PartName, Text
from nmm.scene.methods.cover_tables import OWN, PartTable
from nmm.scene.methods.cover_tables import CoverNet as CoverNet
from nmm.scene.methods.cover_tables import CoverRegion as CoverRegion
from nmm.scene.methods.cover_tables import CoverTable as CoverTable
from nmm.scene.methods.cover_tables import EnrichmentTable as EnrichmentTable
from nmm.scene.methods.edge_tables import GHOST as GHOST
from nmm.scene.methods.edge_tables import ContactMethod as ContactMethod
from nmm.scene.methods.edge_tables import Glue as Glue
from nmm.scene.methods.edge_tables import SupportMethod as SupportMethod
from nmm.scene.methods.step_tables import Diffusion as Diffusion
from nmm.scene.methods.step_tables import IntegratorTable as IntegratorTable
from nmm.scene.methods.step_tables import LoadSteps as LoadSteps
from nmm.scene.methods.step_tables import Rotation as Rotation


class BarPieces(Frozen):
    """How finely bars with a bond are divided."""

    pieces: Count = Field(
        default=40, gt=0, le=10_000, description="a number of pieces of each, > 0", examples=[40]
    )


class Solver(PartTable):
    """Linear solver."""

    type: PartName = Field(
        default="auto",
        description=f'"auto", "cholesky", "lu", "superlu", "qdldl", "mumps" {OWN}',
        examples=["cholesky"],
    )


class Formulation(Frozen):
    """Cover, contact enforcement, integrator, rotation, load steps and linear solver."""

    title: Text = Field(default="", description="a title", examples=["DDA"])
    cover: CoverTable = Field(default=CoverTable(), description="a table [cover]")
    supports: SupportMethod = Field(default=SupportMethod(), description="a table [supports]")
    glue: Glue = Field(default=Glue(), description="a table [glue]")
    contact: ContactMethod = Field(default=ContactMethod(), description="a table [contact]")
    integrator: IntegratorTable = Field(
        default=IntegratorTable(), description="a table [integrator]"
    )
    rotation: Rotation = Field(default=Rotation(), description="a table [rotation]")
    loading: LoadSteps = Field(default=LoadSteps(), description="a table [loading]")
    solver: Solver = Field(default=Solver(), description="a table [solver]")
    diffusion: Diffusion | None = Field(default=None, description="a table [diffusion]")
    bars: BarPieces = Field(default=BarPieces(), description="a table [bars]")

    _source: Source = PrivateAttr(default_factory=lambda: Source("formulation"))

    @property
    def source(self) -> Source:
        """Where it was read; `source.place("cover", "size")` is "file:line: cover.size"."""
        return self._source


UNSAID = {"loading": ("increment",), "contact": ("max_passes",)}
"""Keys whose default is not what is done without them: stages come to rest in one increment, and
every enforcement has passes of its own."""


def read_formulation(path: str | Path) -> Formulation:
    """Formulation of a TOML file.

    Raises
    ------
    FormulationError
        All faults of the file, one line each.
    """
    return parse_formulation(read_text(path, FormulationError), str(path))


def parse_formulation(text: str, place: str = "formulation") -> Formulation:
    """Formulation of a TOML text; `place` names it in errors."""
    formulation, source = parse(text, Formulation, place, FormulationError)
    formulation._source = source
    return formulation


def as_tables(formulation: Formulation) -> dict[str, Any]:
    """Return the tables that read back as the same formulation, with its defaults.

    Keys that mean something else when they are left out stay left out.
    """
    left = {
        table: {key for key in keys if key not in getattr(formulation, table).model_fields_set}
        for table, keys in UNSAID.items()
    }
    return formulation.model_dump(mode="json", by_alias=True, exclude_none=True, exclude=left)


def canonical_text(formulation: Formulation) -> str:
    """The formulation in one form, whatever its file's order, units and comments.

    The pieces of bars are left out where they are those of default, as in earlier versions.
    """
    usual = {"bars"} if formulation.bars == BarPieces() else set()
    content = formulation.model_dump(mode="json", exclude_none=True, exclude=usual)
    return json.dumps(content, sort_keys=True, separators=(",", ":"))


def formulation_hash(formulation: Formulation) -> str:
    """SHA-256 of the canonical text, hexadecimal."""
    return hashlib.sha256(canonical_text(formulation).encode()).hexdigest()
