"""The formulation: how a scene is approximated; no physics here.

The tables of `[cover]` stand in `nmm.scene.cover_tables`.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr, model_validator

from nmm.errors import FormulationError
from nmm.scene.cover_tables import OWN, PartTable
from nmm.scene.cover_tables import CoverNet as CoverNet
from nmm.scene.cover_tables import CoverRegion as CoverRegion
from nmm.scene.cover_tables import CoverTable as CoverTable
from nmm.scene.cover_tables import EnrichmentTable as EnrichmentTable
from nmm.scene.document import parse, read_text
from nmm.scene.faults import Source
from nmm.scene.fields import Count, Frozen, Number, PartName, Text, Time, TimeOrAuto, fault

# Nitsche's ghost term in (lambda + 2 mu) / h^2: measured to keep the matrix positive down to cuts
# of 1e-6 of a cell.
GHOST = 0.5


# What says how steps are chosen, beside step = "auto".
CHOOSING = ("error", "error_of", "shortest", "longest")


class SupportMethod(Frozen):
    """How supports along edges are imposed; points are held by springs."""

    ALWAYS_READ: ClassVar[frozenset[str]] = frozenset({"stiffness"})
    """Keys that any method goes with: the springs of points."""

    method: PartName = Field(
        default="auto",
        description=f'"auto", "penalty", "nitsche", "lagrange" {OWN}; auto is Nitsche\'s method '
        "for meshes of linear materials, else springs",
        examples=["nitsche"],
    )
    stiffness: Number | None = Field(
        default=None, gt=0, description="a spring in E / size of a cell, > 0", examples=[1e4]
    )
    gamma: Number | None = Field(
        default=None, gt=0, description="Nitsche's penalty in (lambda + 2 mu) / size, > 0"
    )
    ghost: Number = Field(
        default=GHOST, ge=0, description="a ghost term in (lambda + 2 mu) / size^2, >= 0"
    )


class Glue(Frozen):
    """How blocks are glued whose interface is bonded and names no stiffness, without contact."""

    ALWAYS_READ: ClassVar[frozenset[str]] = frozenset()
    """Keys that any method goes with."""

    method: PartName = Field(
        default="auto",
        description=f'"auto", "spring", "nitsche", "lagrange" {OWN}; auto is Nitsche\'s method, '
        "and springs where functions have no strain or a material is not linear",
        examples=["nitsche"],
    )
    stiffness: Number | None = Field(
        default=None,
        gt=0,
        description="springs in E / longest edge that elements share, > 0",
        examples=[1e4],
    )
    gamma: Number | None = Field(
        default=None,
        gt=0,
        description="Nitsche's penalty in multiples of the measured bound, 4 by default, > 1",
        examples=[4.0],
    )


class ContactMethod(PartTable):
    """Enforcement of contact and joint conditions."""

    enforcement: PartName = Field(
        default="penalty",
        description=f'"penalty", "augmented", "lagrange", "cone", "barrier" {OWN}',
        examples=["cone"],
    )
    normal_penalty: Number = Field(
        default=10.0, gt=0, description="a multiple of E x thickness, > 0", examples=[10.0]
    )
    shear_ratio: Number = Field(
        default=1.0, gt=0, description="shear over normal penalty, > 0", examples=[1.0]
    )
    bond_stiffness: Number = Field(
        default=0.5,
        gt=0,
        description="a multiple of E / (distance of the blocks' middles), > 0: stiffness of joints",
        examples=[0.5],
    )
    bonds: Literal["auto", "spring", "nitsche"] = Field(
        default="auto",
        description='"auto", "spring" or "nitsche": what holds whole bonds whose interface names '
        "no stiffness; auto is Nitsche's terms, and springs where functions have no strain, "
        "volumes are projected or a material is not linear",
        examples=["nitsche"],
    )
    max_passes: Count = Field(
        default=20,
        gt=0,
        description="a number of open-close passes of springs, > 0",
        examples=[20],
    )
    points: Literal["auto", "vertices", "faces"] = Field(
        default="auto",
        description='"auto", "vertices" or "faces": where contacts that are no joints act: at '
        "corners alone, or spread over the faces that lie on each other; auto is faces for meshes, "
        "and vertices for the springs of energy_momentum",
        examples=["faces"],
    )
    joint_points: Literal["auto", "corners", "gauss"] = Field(
        default="auto",
        description='"auto", "corners" or "gauss": where joints act and are judged along their '
        "edge; auto is gauss where Nitsche's terms hold whole bonds or fields bend along edges, "
        "else corners",
        examples=["gauss"],
    )


class IntegratorTable(PartTable):
    """Time integration of dynamic scenes."""

    type: PartName = Field(
        default="shi",
        description=f'"shi", "newmark", "generalized_alpha", "energy_momentum", '
        f'"central_differences" {OWN}',
        examples=["newmark"],
    )
    step: TimeOrAuto = Field(
        default=1e-3,
        description='a step in s, > 0, or "auto": steps of which each is as long as its error lets',
        examples=["1 ms"],
    )
    error: Number | None = Field(
        default=None,
        ge=1e-7,
        le=0.3,
        description='with step = "auto": what a cycle of vibration may err by, in places and '
        "speeds, as a share of the largest in the run, from 1e-7 to 0.3; 0.01 by default",
        examples=[1e-3],
    )
    error_of: Literal["auto", "points", "bodies"] | None = Field(
        default=None,
        description='with step = "auto": "auto", "points" or "bodies": whose places and speeds are '
        "compared, of all points, or of bodies as if rigid, so that waves within them do not "
        "count; auto is bodies where blocks of one element may touch, else points",
        examples=["bodies"],
    )
    shortest: Time | None = Field(
        default=None,
        gt=0,
        description='with step = "auto": a step in s, > 0, that is taken whatever it errs by; '
        "1e-7 of the duration by default",
        examples=["1 us"],
    )
    longest: Time | None = Field(
        default=None,
        gt=0,
        description='with step = "auto": a step in s, > 0, that none exceeds; a tenth of the '
        "duration by default",
        examples=["10 ms"],
    )
    mass: Literal["consistent", "lumped"] = Field(
        default="consistent",
        description='"consistent" or "lumped": a block for each cover',
        examples=["lumped"],
    )
    kinetic_factor: Number = Field(
        default=1.0, ge=0, le=1, description="a kept fraction of velocity in [0, 1]", examples=[1.0]
    )

    @property
    def fixed_step(self) -> float | None:
        """The length of all steps (s); None where their error chooses."""
        return None if self.step == "auto" else self.step

    @model_validator(mode="after")
    def _chosen(self) -> IntegratorTable:
        given = [key for key in CHOOSING if getattr(self, key) is not None]
        if self.step != "auto" and given:
            expected = f'step = "auto" beside {", ".join(given)}'
            remedy = 'write step = "auto", or remove them'
            raise fault(f"a step of {self.step:g} s", expected, remedy)
        if self.shortest and self.longest and self.shortest > self.longest:
            between = f"shortest {self.shortest:g} s, longest {self.longest:g} s"
            raise fault(between, "a shortest step below the longest", "exchange them")
        return self


class Rotation(Frozen):
    """How bodies move and strain.

    "exact" turns a body with its axes, in which strain is small; "linear" is the update of
    classical DDA, in which areas grow; "small" keeps all bodies where they are (theory of small
    displacements); "finite" measures finite strain at every point, so that one body may bend by
    any angle; "auto" is small for statics without contact and exact for all else.
    """

    update: Literal["auto", "exact", "linear", "small", "finite"] = Field(
        default="auto",
        description='"auto", "exact", "linear", "small" or "finite"',
        examples=["exact"],
    )


class BarPieces(Frozen):
    """How finely bars with a bond are divided."""

    pieces: Count = Field(
        default=40, gt=0, le=10_000, description="a number of pieces of each, > 0", examples=[40]
    )


class LoadSteps(Frozen):
    """Load increments of static scenes."""

    increment: Number = Field(
        default=0.1, ge=1e-6, description="a load factor, at least 1e-6", examples=[0.1]
    )
    tolerance: Number = Field(
        default=0.005,
        ge=1e-9,
        lt=1,
        description="a relative tolerance in [1e-9, 1)",
        examples=[0.005],
    )
    budget: Time | None = Field(
        default=None,
        gt=0,
        description="seconds on the wall clock after which a run ends, static or dynamic, > 0",
        examples=["10 min"],
    )
    max_steps: Count | None = Field(
        default=None,
        gt=0,
        description="a number of steps after which a run ends, static or dynamic, > 0",
        examples=[1000],
    )


class Solver(PartTable):
    """Linear solver."""

    type: PartName = Field(
        default="auto",
        description=f'"auto", "cholesky", "lu", "superlu", "qdldl", "mumps" {OWN}',
        examples=["cholesky"],
    )


class Diffusion(Frozen):
    """Steps in time of temperature and water heads, which are those of the run or parts of them."""

    theta: Number = Field(
        default=1.0,
        ge=0.5,
        le=1.0,
        description="a weight of the end of a step in [0.5, 1]: 0.5 is of order 2, 1 damps most",
        examples=[0.5],
    )
    step: Time | None = Field(
        default=None, gt=0, description="the longest step in s, > 0", examples=["60 s"]
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
