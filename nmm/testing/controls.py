"""What every control of a path is held to."""

import nmm
from nmm.scene.model import Scene
from nmm.testing.claims import claim, close

# Peaks of bonds that break at once hang on no step; what softens bends within one.
BRITTLE, SOFT = 1e-8, 1e-3
# Balance, and energy made or lost over all that went through.
BALANCED, KEPT = 1e-8, 2e-3


def check_control(scene: Scene) -> None:
    """Check the control of a scene that is followed past its peak in seconds.

    Every step is in balance and energy is kept; steps of a third lead to the same peak, and the run
    says that a limit point was passed and nowhere carries more than its peak.

    Raises
    ------
    AssertionError
        Saying what is not kept and by how much.
    """
    loading = scene.loading
    if loading is None or loading.control is None:
        raise AssertionError("scene: it has no [loading.control], which names the control to check")
    given = loading.control
    finer = {
        name: getattr(given, name) / 3
        for name in ("increment", "energy")
        if getattr(given, name) is not None
    }
    control = given.model_copy(update=finer)
    fine = scene.model_copy(update={"loading": loading.model_copy(update={"control": control})})
    whole = nmm.run(scene)
    more = nmm.run(fine) if finer else whole  # from event to event there are no steps to choose
    peaks = [run.summary.failure_factor for run in (whole, more)]
    claim(None not in peaks, "no peak was passed")
    peak, other = (float(one or 0.0) for one in peaks)
    soft = any(one.fracture_energy is not None for one in scene.interfaces.values())
    close("peak with steps of a third", other, peak, SOFT if soft else BRITTLE)
    for run in (whole, more):
        factor = run.history["load_factor"]
        claim(float(factor.max()) <= max(peak, other) * (1 + BRITTLE), "more than the peak")
        residual, lost = run.summary.equilibrium_residual, run.summary.energy_balance
        claim(residual is not None and residual <= BALANCED, "out of balance on the path")
        claim(lost is not None and abs(lost) <= KEPT, "energy is not kept")
