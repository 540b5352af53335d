"""Thresholds of the solution of equations: forces out of balance, rounding, dependence."""

from nmm.stepping.audits.thresholds.base import Threshold

SOLUTION: dict[str, Threshold] = {
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
}
