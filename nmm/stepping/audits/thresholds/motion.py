"""Thresholds of how bodies move and meet: overlap, momentum, length of steps, strain, supports."""

from nmm.stepping.audits.thresholds.base import Threshold

MOTION: dict[str, Threshold] = {
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
}
