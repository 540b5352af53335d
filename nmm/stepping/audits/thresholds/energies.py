"""Thresholds of energies that come from nowhere, or are lost, where nothing says so."""

from nmm.stepping.audits.thresholds.base import Threshold

ENERGIES: dict[str, Threshold] = {
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
}
