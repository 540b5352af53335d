"""Tables of the steps of a run: integrator, kinematics, load increments, diffusion."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from nmm.scene.fields import Count, Frozen, Number, PartName, Time, TimeOrAuto, fault
from nmm.scene.methods.cover_tables import OWN, PartTable

# Keys of adaptive steps, beside step = "auto".
CHOOSING = ("error", "error_of", "shortest", "longest")


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
        description='a number from 1e-7 to 0.3, with step = "auto": what a cycle of vibration may '
        "err by, in places and speeds, as a share of the largest in the run; 0.01 by default",
        examples=[1e-3],
    )
    error_of: Literal["auto", "points", "bodies"] | None = Field(
        default=None,
        description='"auto", "points" or "bodies", with step = "auto": whose places and speeds are '
        "compared, of all points, or of bodies as if rigid, so that waves within them do not "
        "count; auto is bodies where blocks of one element may touch, else points",
        examples=["bodies"],
    )
    shortest: Time | None = Field(
        default=None,
        gt=0,
        description='a step in s, > 0, with step = "auto": it is taken whatever it errs by; 1e-7 '
        "of the duration by default",
        examples=["1 us"],
    )
    longest: Time | None = Field(
        default=None,
        gt=0,
        description='a step in s, > 0, with step = "auto": none exceeds it; a tenth of the '
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
        """The length of all steps (s); None where the error determines it."""
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
