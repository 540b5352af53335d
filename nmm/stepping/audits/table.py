"""The thresholds of all audits, in the one place where they stand."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Threshold:
    """When an audit speaks.

    Attributes
    ----------
    what
        The number that is measured.
    warns
        Beyond this there is a warning.
    fails
        Beyond this a run that was solved counts as "unbalanced"; None where an audit only warns.
    where
        Runs that are audited.
    """

    what: str
    warns: float
    fails: float | None
    where: str


THRESHOLDS: dict[str, Threshold] = {
    "energy_made_in_step": Threshold(
        "rise of stored energy and losses less work in one step, over the turnover",
        1e-6,
        1e-2,
        "dynamics",
    ),
    "energy_made_in_run": Threshold("the same over any stretch of the run", 1e-4, 1e-2, "dynamics"),
    "energy_made_by_damping": Threshold(
        "energy that dampers, friction and bonds gave in all, and matter that flows in some steps, "
        "over the turnover",
        1e-6,
        1e-2,
        "dynamics",
    ),
    "energy_made_by_friction": Threshold(
        "energy that friction and bonds gave in the increments in which they took less than "
        "nothing, over the turnover",
        1e-2,
        0.1,
        "statics with contact",
    ),
    "energy_lost": Threshold(
        "energy that neither friction nor dampers took, over the turnover",
        0.1,
        None,
        "dynamics without asked-for damping (`kinetic_factor` below 1)",
    ),
    "record_damped": Threshold(
        "energy that the integrator took of a motion that records drive, over the turnover",
        0.02,
        None,
        "dynamics with `motion` or `incoming` waves",
    ),
    "work_not_stored": Threshold(
        "difference of work and stored energy beyond rounding, over the larger of both",
        1e-6,
        1e-2,
        "statics of small displacements without contact",
    ),
    "energy_released": Threshold(
        "energy that neither stores nor losses account for, over the turnover",
        0.05,
        None,
        "statics with contact, and of bodies that turn",
    ),
    "not_finite": Threshold("energies that are no finite numbers", 0, 0, "all"),
    "residual": Threshold(
        "largest out-of-balance force of an accepted step, over the load", 1e-6, 1e-3, "all"
    ),
    "force_balance": Threshold(
        "force and moment (over width) left on a body where the run ends, over the size of all "
        "forces on it, or 1e-3 of the largest size",
        1e-6,
        1e-3,
        "statics that were solved, of bodies that no multipliers hold (it only warns of forces "
        "below the rounding of a place times what holds it); `[loading.control]`, of all bodies "
        "together",
    ),
    "field_imbalance": Threshold(
        "heat or water that was taken up and is not stored, over all that came and went",
        1e-8,
        1e-3,
        "heat and water that flow",
    ),
    "condition": Threshold(
        "estimate of the condition number of the last system", 1e14, None, "all"
    ),
    "rounding": Threshold(
        "change of a displacement that rounding of the last solution may make, over the largest "
        "displacement",
        1e-6,
        None,
        "statics without contact",
    ),
    "smallest_cut": Threshold(
        "largest element over the smallest", 1e10, None, "covers that cut blocks"
    ),
    "dependent_functions": Threshold(
        "share of dependent functions among the unknowns, where the residual exceeds 1e-8",
        0.0,
        None,
        "all",
    ),
    "penetration": Threshold(
        "largest overlap of two bodies, measured where steps end, over the size (root of the area) "
        "of the smaller",
        2e-3,
        0.1,
        "contact; it only warns where an interface names its stiffness",
    ),
    "mass": Threshold(
        "change of the bodies' total area", 1e-6, None, '`[rotation] update = "linear"`'
    ),
    "momentum": Threshold(
        "change of the momentum less the impulse of weight, over the larger of the sum of all "
        "bodies' and what they would have if all motion went one way",
        1e-8,
        1e-4,
        "dynamics without supports and loads",
    ),
    "angular_momentum": Threshold(
        "change of the angular momentum, over the larger of the sum of all bodies' and what they "
        "would have if all motion were spin",
        1e-8,
        1e-3,
        "dynamics without supports, loads and weight, unless axes stay",
    ),
    "rebound_in_step": Threshold(
        "largest energy with which bodies part at the end of a step at whose start they met, and "
        "in which waves cross the smaller of both, over the turnover",
        0.02,
        None,
        "dynamics with exact enforcements of contact",
    ),
    "contact_duration": Threshold(
        "time step over the duration of an impact of the lightest body, where springs of contact "
        "lost more than 1 % of the turnover",
        0.1,
        None,
        "dynamics with springs in contact",
    ),
    "record_step": Threshold(
        "time step over the time between samples of a record that drives the run",
        0.5 * (1 + 1e-9),
        None,
        "dynamics with records",
    ),
    "step_error": Threshold(
        "steps that erred by more than was asked for and were to be no shorter",
        0.0,
        None,
        'runs with `[integrator] step = "auto"`',
    ),
    "failure_tolerance": Threshold(
        "width of the bracket of a failure load over `[loading] tolerance`",
        1.01,
        None,
        "runs until failure",
    ),
    "large_strain": Threshold(
        "largest mean strain of an element where a run ends, in any direction",
        0.1,
        None,
        'contact, and bodies that turned in dynamics, unless `[rotation] update = "finite"`',
    ),
    "soft_supports": Threshold(
        "energy in springs that hold edges where a run ends, over that of the matter they hold",
        2e-3,
        None,
        "supports along edges of meshes by springs",
    ),
    "kept_whole": Threshold(
        "largest share of its strength that a block uses where a run ends, and splits no more",
        1.1,
        None,
        "`[splitting]`",
    ),
    "split_energy": Threshold(
        "energy that cuts of blocks that split added or took, over the turnover",
        2e-2,
        0.5,
        "`[splitting]` in dynamics without `[fracture]` and `[[stages]]`",
    ),
    "growth_energy": Threshold(
        "energy that growth freed less what its toughness took, over the largest energy",
        1e-3,
        None,
        '`[fracture]` with `control = "toughness"`',
    ),
    "growth_projection": Threshold(
        "energy that laying functions anew about grown tips added or took, over the turnover",
        2e-2,
        0.5,
        "`[fracture]` in dynamics without `[[stages]]`",
    ),
    "unstable_ways": Threshold(
        "most independent ways in which what softens together gives way, one of which a control "
        "holds",
        1,
        None,
        "`[loading.control]`",
    ),
    "growth_swing": Threshold(
        "angle (rad) by which pieces of a crack turn one way and at once back",
        0.2,
        None,
        "`[fracture]`",
    ),
    "crowded_tips": Threshold(
        "one and a half cells over the distance of a tip from a crack beside it, or 0.6 cells over "
        "that from an edge",
        1.0,
        None,
        "`[fracture]`",
    ),
    "nucleation_length": Threshold(
        "largest stress over the strength of cracks that begin, where no line of the mean fits "
        "across what is pulled",
        0.999,
        None,
        "`[fracture.nucleation]`",
    ),
    "faces_overlap": Threshold(
        "overlap of the faces of a crack, over the largest distance between faces; or -K_I, over K "
        "of both modes, of a tip that grew",
        0.05,
        None,
        "cracks without `[contact]`",
    ),
    "increments": Threshold(
        "ten over the number of increments in which friction slid or bonds broke",
        1.0,
        None,
        "`[loading]` up to a factor, with contact",
    ),
    "first_increment": Threshold(
        "what friction took in the first increment, over the turnover",
        1e-3,
        None,
        "statics with contact and initial stress",
    ),
    "softening_under_pressure": Threshold(
        "size of a cell in which friction falls over the largest under its pressure, about",
        1.0,
        None,
        "`mohr_coulomb` and `drucker_prager` with `softening_energy`",
    ),
    "softening_across_cells": Threshold(
        "mean angle (rad) of bands of flow from the nearest edges of their cells",
        0.15,
        None,
        "matter with `softening_energy`",
    ),
    "ellipticity": Threshold(
        "least determinant of an acoustic tensor where matter flows, below zero, over the elastic "
        "one in the mean over all angles",
        1e-6,
        None,
        "matter that yields, without `softening_energy`",
    ),
    "not_audited": Threshold(
        "1 where audits could not be made of the last state, as no forces of a part exist there",
        0.5,
        0.5,
        "all",
    ),
}


def markdown() -> str:
    """Return the table as a page shows it."""
    lines = ["| audit | what | warns above | fails above | which runs |", "|---|---|---|---|---|"]
    for name, row in THRESHOLDS.items():
        fails = "" if row.fails is None else f"{row.fails:g}"
        lines.append(f"| `{name}` | {row.what} | {row.warns:g} | {fails} | {row.where} |")
    return "\n".join(lines)
