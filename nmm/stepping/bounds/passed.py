"""What a run says whose load has passed the bound that the static theorem gave where it began.

The bound takes blocks, members and water as they were there. A bolt that yields turns as its block
slides on a plane of friction angle phi, and at its most holds ``T / cos(phi)`` along the plane,
whatever the angle it was drawn at: more than the bound counts, and rightly so.
"""

from dataclasses import replace

from nmm.results.summary import Summary

# Loads above the bound by more than this, relative: penetration and the stretch of what yields
# change places by 1e-4 of the size of blocks.
PASSED = 1e-3


def beside_bound(summary: Summary, bound: float | None) -> Summary:
    """Return the summary of a run with the bound, and a warning where its load has passed it."""
    said, reached = replace(summary, failure_bound=bound), summary.failure_factor
    if bound is None or reached is None or reached <= bound + PASSED * abs(bound):
        return said
    warning = (
        f"load factor {reached:.6g} lies above the bound of the static theorem, {bound:.6g}, which "
        "is of the place where the run began: blocks have moved, members turned or water has "
        "changed since, and carry more; for the load of the drawn place "
        'take [rotation] update = "small"'
    )
    return replace(said, warnings=[*said.warnings, warning])
