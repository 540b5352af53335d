"""The formulation: how a scene is approximated; no physics here."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, PrivateAttr, model_validator

from nmm.errors import FormulationError
from nmm.scene.document import parse, read_text
from nmm.scene.faults import Source
from nmm.scene.fields import (
    Angle,
    BlockName,
    Count,
    Flag,
    Frozen,
    Length,
    Number,
    PartName,
    Point,
    Ring,
    Time,
    fault,
)

_OWN = 'or "module:Name"'
_OF_BLOCKS = ("block", "sub_blocks")


class _Part(Frozen):
    """A part that can be exchanged; `options` is checked by the part itself."""

    options: dict[str, Any] = Field(default={}, description="a table of options of the part")


class Enrichment(Frozen):
    """Singular functions on the covers about all crack tips, and about corners that are named.

    Without the table the covers about a tip carry its functions where the crack is straight and
    alone in them.
    """

    radius: Length = Field(
        default=0.0,
        ge=0,
        description="a radius in m, >= 0: covers that are nearer to the point carry the functions; "
        "those that touch it always do",
        examples=[0.2],
    )
    tips: Flag = Field(
        default=True,
        description="true or false: whether covers about crack tips carry the functions",
        examples=[False],
    )
    corners: tuple[Point, ...] = Field(
        default=(), description="a list of re-entrant corners [x, y] in m", examples=[[[0, 0]]]
    )


class CoverRegion(Frozen):
    """Covers of another degree: those in a polygon, of a block, or near a point.

    A cover belongs to the place where the centroid of its material lies; of several regions that
    hold it the last one counts.
    """

    degree: Count = Field(ge=0, le=3, description="a degree, 0 to 3", examples=[2])
    polygon: Ring | None = Field(
        default=None,
        description="a list of three corners [x, y] in m or more",
        examples=[[[0, 0], [1, 0], [1, 1]]],
    )
    block: BlockName | None = Field(
        default=None, description='the name of a block, or of a piece "beam.12"', examples=["beam"]
    )
    point: Point | None = Field(
        default=None, description="a point [x, y] in m, with a radius", examples=[[0.5, 0]]
    )
    radius: Length | None = Field(
        default=None, gt=0, description="a distance to the point in m, > 0", examples=[0.2]
    )

    @model_validator(mode="after")
    def _one_place(self) -> CoverRegion:
        given = [name for name in ("polygon", "block", "point") if getattr(self, name) is not None]
        if len(given) != 1:
            raise fault(
                ", ".join(given) or "none",
                "one of polygon, block, point",
                "name one place a region; write a region for each further place",
            )
        if (self.point is None) != (self.radius is None):
            raise fault(
                f"point {self.point}, radius {self.radius}",
                "a point with a radius",
                "write both, or neither",
            )
        return self


class CoverNet(Frozen):
    """A net of its own for a block; what is not given is that of the common net."""

    block: BlockName = Field(description="the name of a block", examples=["beam"])
    size: Length | None = Field(
        default=None, gt=0, description="a cover size in m, > 0", examples=[0.02]
    )
    angle: Angle | None = Field(
        default=None, description="a turn of the mesh in rad", examples=["17 deg"]
    )
    shift: tuple[Number, Number] | None = Field(
        default=None,
        description="a displacement of the mesh in fractions of a cell",
        examples=[[0.3, 0.2]],
    )


class Cover(_Part):
    """Physical covers and their local functions: block = DDA, meshes = manifold.

    The type "sub_blocks" divides blocks and glues the parts.

    A mesh has local functions "monomials" of degree 1 unless others are named.
    """

    type: PartName = Field(
        default="block",
        description='"block", "sub_blocks", "triangles", "quads", "graded", "bspline", "mls" '
        f"{_OWN} of a cover",
        examples=["triangles"],
    )
    functions: PartName = Field(
        default="rigid_strain",
        description='"rigid_strain", "rigid" or "monomials"; meshes take monomials',
        examples=["monomials"],
    )
    degree: Count | None = Field(
        default=None, ge=0, description="a degree, an integer >= 0", examples=[1]
    )
    size: Length | None = Field(
        default=None, gt=0, description="a cover size in m, > 0", examples=[0.1]
    )
    angle: Angle = Field(default=0.0, description="a turn of the mesh in rad", examples=["17 deg"])
    shift: tuple[Number, Number] = Field(
        default=(0.0, 0.0),
        description="a displacement of the mesh in fractions of a cell",
        examples=[[0.3, 0.2]],
    )
    enrichment: Enrichment | None = Field(default=None, description="a table [cover.enrichment]")
    regions: tuple[CoverRegion, ...] | None = Field(
        default=None, description="tables [[cover.regions]]"
    )
    nets: tuple[CoverNet, ...] | None = Field(default=None, description="tables [[cover.nets]]")

    @property
    def finest(self) -> float | None:
        """Smallest size of a net (m)."""
        sizes = [self.size, *(item.size for item in self.nets or ())]
        return min((size for size in sizes if size is not None), default=None)

    @property
    def highest_degree(self) -> int:
        """Highest degree of the polynomials, over all regions."""
        return max([self.degree or 0, *(item.degree for item in self.regions or ())])

    @property
    def of_blocks(self) -> bool:
        """Whether each block, or sub-block, has one cover of its own."""
        return self.type in _OF_BLOCKS

    @property
    def glued(self) -> bool:
        """Whether blocks are divided into sub-blocks that never part."""
        return self.type == "sub_blocks" and self.options.get("bond", "elastic") == "elastic"

    @model_validator(mode="before")
    @classmethod
    def _mesh(cls, data: Any) -> Any:
        """Meshes carry polynomials unless something else is asked for."""
        if not isinstance(data, Mapping) or data.get("type", "block") in _OF_BLOCKS:
            return data
        plain = {"functions": "monomials"} if "functions" not in data else {}
        monomials = data.get("functions", "monomials") == "monomials"
        degree = {"degree": 1} if monomials and data.get("degree") is None else {}
        return {**data, **plain, **degree}


class SupportMethod(Frozen):
    """How supports along edges are imposed; points are held by springs."""

    method: Literal["auto", "penalty", "nitsche", "lagrange"] = Field(
        default="auto",
        description='"auto", "penalty", "nitsche" or "lagrange"; auto is springs for blocks and '
        "Nitsche's method for meshes",
        examples=["nitsche"],
    )
    stiffness: Number | None = Field(
        default=None, gt=0, description="a spring in E / size of a cell, > 0", examples=[1e4]
    )
    gamma: Number | None = Field(
        default=None, gt=0, description="Nitsche's penalty in (lambda + 2 mu) / size, > 0"
    )
    ghost: Number = Field(
        default=0.5, ge=0, description="a ghost term in (lambda + 2 mu) / size^2, >= 0"
    )


class Glue(Frozen):
    """How blocks are glued whose interface is bonded and names no stiffness, without contact."""

    method: Literal["auto", "spring", "nitsche", "lagrange"] = Field(
        default="auto",
        description='"auto", "spring", "nitsche" or "lagrange"; auto is Nitsche\'s method, and '
        "springs where functions have no strain",
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


class ContactMethod(_Part):
    """Enforcement of contact and joint conditions."""

    enforcement: PartName = Field(
        default="penalty",
        description=f'"penalty", "augmented", "lagrange", "cone", "barrier" {_OWN}',
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
    max_passes: Count = Field(
        default=20,
        gt=0,
        description="a number of open-close passes of springs, > 0",
        examples=[20],
    )
    points: Literal["auto", "vertices", "faces"] = Field(
        default="auto",
        description='"auto", "vertices" or "faces": where contacts that are no joints act: at '
        "corners alone, or spread over the faces that lie on each other; auto is faces for meshes",
        examples=["faces"],
    )
    joint_points: Literal["corners", "gauss"] = Field(
        default="corners",
        description='"corners" or "gauss": where joints act and are judged along their edge',
        examples=["gauss"],
    )


class Integrator(_Part):
    """Time integration of dynamic scenes."""

    type: PartName = Field(
        default="shi",
        description=f'"shi", "newmark", "generalized_alpha" {_OWN}',
        examples=["newmark"],
    )
    step: Time = Field(default=1e-3, gt=0, description="a step in s, > 0", examples=["1 ms"])
    mass: Literal["consistent", "lumped"] = Field(
        default="consistent",
        description='"consistent" or "lumped": a block for each cover',
        examples=["lumped"],
    )
    kinetic_factor: Number = Field(
        default=1.0, ge=0, le=1, description="a kept fraction of velocity in [0, 1]", examples=[1.0]
    )


class Rotation(Frozen):
    """How a step's rotation moves a body.

    "exact" turns it; "linear" is the update of classical DDA, in which areas grow; "small" keeps
    all bodies where they are (theory of small displacements); "auto" is small for statics without
    contact and exact for all else.
    """

    update: Literal["auto", "exact", "linear", "small"] = Field(
        default="auto",
        description='"auto", "exact", "linear" or "small"',
        examples=["exact"],
    )


class LoadSteps(Frozen):
    """Load increments of static scenes."""

    increment: Number = Field(default=0.1, gt=0, description="a load factor > 0", examples=[0.1])
    tolerance: Number = Field(
        default=0.005, gt=0, lt=1, description="a relative tolerance in (0, 1)", examples=[0.005]
    )


class Solver(_Part):
    """Linear solver."""

    type: PartName = Field(
        default="auto",
        description=f'"auto", "cholesky", "lu", "superlu", "qdldl" {_OWN}',
        examples=["cholesky"],
    )


class Formulation(Frozen):
    """Cover, contact enforcement, integrator, rotation, load steps and linear solver."""

    title: str = Field(default="", description="a title", examples=["DDA"])
    cover: Cover = Field(default=Cover(), description="a table [cover]")
    supports: SupportMethod = Field(default=SupportMethod(), description="a table [supports]")
    glue: Glue = Field(default=Glue(), description="a table [glue]")
    contact: ContactMethod = Field(default=ContactMethod(), description="a table [contact]")
    integrator: Integrator = Field(default=Integrator(), description="a table [integrator]")
    rotation: Rotation = Field(default=Rotation(), description="a table [rotation]")
    loading: LoadSteps = Field(default=LoadSteps(), description="a table [loading]")
    solver: Solver = Field(default=Solver(), description="a table [solver]")

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
    """The formulation in one form, whatever its file's order, units and comments."""
    content = formulation.model_dump(mode="json", exclude_none=True)
    return json.dumps(content, sort_keys=True, separators=(",", ":"))


def formulation_hash(formulation: Formulation) -> str:
    """SHA-256 of the canonical text, hexadecimal."""
    return hashlib.sha256(canonical_text(formulation).encode()).hexdigest()
