"""Tables of the imposition of edge conditions: supports, glued blocks, contact."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from nmm.scene.fields import Count, Frozen, Number, PartName
from nmm.scene.methods.cover_tables import OWN, PartTable

# Ghost penalty of Nitsche's method in (lambda + 2 mu) / h^2, which keeps the matrix positive
# definite down to cuts of 1e-6 of a cell (measured).
GHOST = 0.5


class SupportMethod(Frozen):
    """How supports along edges are imposed; points are supported by springs."""

    ALWAYS_READ: ClassVar[frozenset[str]] = frozenset({"stiffness"})
    """Keys that every method uses: the springs of points."""

    method: PartName = Field(
        default="auto",
        description=f'"auto", "penalty", "nitsche", "lagrange" {OWN}; auto is Nitsche\'s method '
        "for meshes of linear materials, and of finite strain in statics without contact, else "
        "springs",
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
    """Keys that every method uses."""

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
