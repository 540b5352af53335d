"""The table ``[damping]``: Rayleigh damping and local damping."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator, Field, model_validator

from nmm.errors import shown
from nmm.scene.fields import Frozen, Name, Number, Time, fault, quantity


def _no_angle(value: object) -> object:
    if isinstance(value, str) and "rad" in value:
        remedy = 'divide it by 2 pi, and write for example "2 Hz"'
        raise fault(shown(value), "cycles a second in Hz, no angle a second", remedy)
    return value


Rate = Annotated[float, quantity("1/s")]
Frequency = Annotated[float, quantity("1/s"), BeforeValidator(_no_angle)]


class DampingTable(Frozen):
    """Damping of the motion of the material; needs inertia.

    Viscous (Rayleigh) damping is `mass` times the mass plus `stiffness` times the elastic stiffness
    of the material, given by these factors or by damping ratios at two frequencies. Local damping
    multiplies the mass by 1 / (1 - `local`) while it accelerates and by 1 / (1 + `local`) while it
    decelerates: it dissipates energy at every frequency alike, and is for coming to rest. A body in
    free fall falls with (1 - `local`) of its weight.
    """

    mass: Rate | None = Field(
        default=None, ge=0, description="a rate in 1/s, >= 0", examples=["1.05 1/s"]
    )
    stiffness: Time | None = Field(
        default=None, ge=0, description="a time in s, >= 0", examples=["1.33 ms"]
    )
    ratios: tuple[Number, Number] | None = Field(
        default=None,
        description="two ratios of critical damping, from 0 to 1",
        examples=[[0.05, 0.05]],
    )
    frequencies: tuple[Frequency, Frequency] | None = Field(
        default=None,
        description="two frequencies in Hz, > 0, at which the ratios are",
        examples=[["2 Hz", "10 Hz"]],
    )
    ground: Name | None = Field(
        default=None,
        description="the name of a support with a motion, against which mass damps; axes at rest "
        "when not given",
        examples=["base"],
    )
    local: Number | None = Field(
        default=None,
        ge=0,
        lt=1,
        description="a share of the out-of-balance force, from 0 to below 1",
        examples=[0.7],
    )

    @model_validator(mode="after")
    def _check(self) -> DampingTable:
        plain = self.mass is not None or self.stiffness is not None
        if (self.ratios is None) != (self.frequencies is None):
            lacks = "frequencies" if self.frequencies is None else "ratios"
            raise fault(f"no {lacks}", "ratios with frequencies", f"add {lacks}, or remove both")
        if plain and self.ratios is not None:
            expected = "mass and stiffness, or ratios and frequencies"
            raise fault("both", expected, "remove one of the two ways")
        if not plain and self.ratios is None and self.local is None:
            remedy = "add for example ratios and frequencies, or remove [damping]"
            raise fault("nothing", "mass, stiffness, ratios or local", remedy)
        if self.ground is not None and not plain and self.ratios is None:
            remedy = "add mass, or ratios and frequencies"
            raise fault("ground without mass", "damping by mass", remedy)
        if self.ratios is not None and self.frequencies is not None:
            _check_rayleigh(self.ratios, self.frequencies)
        return self

    @property
    def coefficients(self) -> tuple[float, float] | None:
        """Factors of mass (1/s) and stiffness (s); None without viscous damping."""
        if self.ratios is not None and self.frequencies is not None:
            return rayleigh(self.ratios, self.frequencies)
        if self.mass is None and self.stiffness is None:
            return None
        return self.mass or 0.0, self.stiffness or 0.0


def rayleigh(ratios: tuple[float, float], hertz: tuple[float, float]) -> tuple[float, float]:
    """Return a (1/s) and b (s) with ``ratio = a / (2 w) + b w / 2`` at both frequencies."""
    from math import pi

    (one, other), (low, high) = ratios, (2 * pi * hertz[0], 2 * pi * hertz[1])
    span = high**2 - low**2
    mass = 2 * low * high * (one * high - other * low) / span
    return mass, 2 * (other * high - one * low) / span


def _check_rayleigh(ratios: tuple[float, float], hertz: tuple[float, float]) -> None:
    if not all(0 <= one <= 1 for one in ratios):
        raise fault(list(ratios), "ratios from 0 to 1", "write 0.05 for five per cent")
    if min(hertz) <= 0 or hertz[0] == hertz[1]:
        raise fault(list(hertz), "two different frequencies > 0", "correct the frequencies")
    mass, stiffness = rayleigh(ratios, hertz)
    # Rounding of two products of similar size.
    if mass < -1e-12 * max(ratios) * max(hertz) or stiffness < -1e-12 * max(ratios) / min(hertz):
        low, high = min(hertz) / max(hertz), max(hertz) / min(hertz)
        shown = f"ratios {list(ratios)} at {list(hertz)} Hz"
        remedy = "other frequencies would be driven, not damped: bring the ratios closer"
        raise fault(shown, f"a second ratio of {low:.3g} to {high:.3g} times the first", remedy)
