"""Whether springs that hold edges of meshes give way by more than an answer can bear."""

from typing import TYPE_CHECKING

from nmm.effects.base import Instant
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent

if TYPE_CHECKING:
    from nmm.constraints.supports import Supports


# Strain below which matter rests but for rounding, as in ground at rest under its stress.
STRAIN_AT_REST = 1e-12


def supports(run: EndedRun) -> Findings:
    """Audit the energy in springs along held edges of meshes, beside that of the matter.

    The largest stress of a square pulled at its edges is off by one to seven times this share.
    Blocks of covers of their own are held by springs as Shi's are, and left out.
    """
    stepper, state = run.stepper, run.state
    held: Supports | None = stepper.plan.supports
    if held is None or not stepper.model.manifold.shared_covers:
        return
    strained = stepper.model.strain_energy(state)
    edges = [one for one in held.ties if one.interface.first.normal is not None]
    jumps = dict(zip(map(id, held.ties), held.jumps.at(state, Instant.of(state)), strict=True))
    energy = {
        one.interface.name: one.energy(state, jumps[id(one)])
        for one in edges
        if one.springs is not None
    }
    volume = float(stepper.model.element_area.sum()) * stepper.model.thickness
    at_rest = float(stepper.model.modulus.max()) * volume * STRAIN_AT_REST**2 / 2
    if not energy or not strained > at_rest:
        return
    softest = max(energy, key=lambda name: energy[name])
    share = sum(energy.values()) / strained
    yield AuditFinding(
        "soft_supports",
        share,
        f"springs of supports along edges hold {percent(share)} of the energy of what they hold, "
        f'most of it those of "{softest}": they are no stiffer than the error of cells as coarse '
        "as these",
        'take smaller cells, or under [supports] stiffness = 1e4, or method = "lagrange" where '
        "matter is elastic",
    )
