"""Jointed slopes over friction, step, size, enforcement and integrator: every pair of them once.

Twenty-five slopes stand for the 2 500 of the whole product. Row ``(i, j)`` of the array, both of 0
to 4, takes values ``i``, ``j``, ``i + j``, ``i + 2 j``, ``i + 3 j`` modulo 5 of its five columns,
so that of any two columns every pair of values is met exactly once (Bush 1952).
"""

from collections.abc import Iterator

import numpy as np

from nmm.verification.hard.cases.base import HardCase, HardClass
from nmm.verification.hard.cases.parts import (
    enforcements,
    integrators_of_contact,
    with_integrator,
    with_parts,
)
from nmm.verification.hard.cases.writing import in_time
from nmm.verification.hard.generators.slopes import slope
from nmm.verification.hard.oracles.motion import moving

LEVELS = 5
FRICTIONS = (0.0, 10.0, 20.0, 35.0, 45.0)
STEPS = (5e-3, 2e-3, 1e-3, 3e-4, 1e-4)
SIZES = (40, 60, 100, 200, 400)
MOST_STEPS = {40: 60, 60: 60, 100: 60, 200: 25, 400: 10}


class SlopeArray(HardClass):
    """Rock slopes of two and three joint sets in turn, another slope for every row of the array."""

    name = "slope_array"
    title = (
        "slopes of 40 to 400 blocks: friction 0 to 45 degrees, steps of 5 to 0.1 ms, every "
        "enforcement and integrator, every pair of these once"
    )
    oracle = "energy never rises, nobody through anybody, area kept"
    share = LEVELS**2
    listed = True

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield the slope of one row of the array; another one from 25 seeds later on."""
        i, j = divmod(seed % LEVELS**2, LEVELS)
        columns = [(i + factor * j) % LEVELS for factor in (1, 2, 3)]
        names, times = enforcements(), integrators_of_contact()
        enforcement, integrator = names[i % len(names)], times[j % len(times)]
        friction, step, count = FRICTIONS[columns[0]], STEPS[columns[1]], SIZES[columns[2]]
        sets = 2 + seed % 2
        scene = slope(sets, count, friction, seed, np.random.default_rng([seed, sets, 37]))
        steps = int(np.clip(round(0.05 / step), 10, MOST_STEPS[count]))
        heavy = 9.81 if step > 7e-4 else 98.1  # so that corners pass in fewer short steps
        made = with_parts(
            in_time(scene, step, steps, heavy),
            {
                "contact.enforcement": enforcement,
                **with_integrator(integrator),
                "integrator.step": step,
            },
        )
        parts = {
            **{"enforcement": enforcement, "integrator": integrator},
            **{"joint sets": f"{sets} sets", "blocks": f"{count} blocks"},
            **{"friction": f"{friction:g} deg", "step": f"{step:g} s"},
        }
        words = f"seed {seed}, {sets} sets, about {count} blocks, {friction:g} deg"
        label = f"{words}, {step:g} s, {enforcement}, {integrator}"
        yield HardCase(label, made, moving, parts, slow=True)
