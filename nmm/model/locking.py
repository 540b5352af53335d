"""How much a nearly incompressible material locks a cover, in words: one function, one sentence."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from nmm.assembly.model import Model

# Measured by the degree up to which a cover holds all polynomials, over ``-log10(1 - 2 nu)``:
# errors in percent of the pressures of elements, root of the mean square, in a thick cylinder of
# four cells across its wall; and by how much a clamped cavity of ten cells a side gives less.
DECADES = (1.0, 1.7, 2.7, 3.7, 5.7, 6.7)
PRESSURE = {
    1: (115.0, 390.0, 970.0, 1700.0, 21000.0, 33000.0),
    2: (1.6, 3.7, 18.0, 64.0, 1600.0, 11000.0),
    3: (0.1, 0.3, 1.0, 6.0, 100.0, 270.0),
    4: (0.01, 0.03, 0.1, 0.5, 11.0, 31.0),
}
SHORT = {
    1: (15.0, 34.0, 70.0, 94.0, 99.0, 100.0),
    2: (2.5, 4.2, 7.6, 12.0, 28.0, 38.0),
    3: (1.1, 1.9, 2.6, 3.1, 4.7, 5.1),
}
# Larger errors of pressures (percent) are reported, from this Poisson ratio on.
TOLD, FROM = 5.0, 0.45
# Pressures on patches for each unknown from which on they oscillate: one for two on covers of
# degree 0, one for six on those of degree 1.
CROWDED = 0.3


def locking(model: "Model") -> str | None:
    """Return what a Poisson ratio near 1/2 does to this model; None where it does no harm."""
    # In plane strain the ratio of these stiffnesses is nu / (1 - nu); in plane stress it is nu.
    ratio = float((model.elasticity[:, 0, 1] / model.elasticity[:, 0, 0]).max(initial=0.0))
    poisson = ratio / (1 + ratio)
    reproduced = model.manifold.reproduction
    if poisson <= FROM:
        return None
    if reproduced is None:
        return _parted(model, poisson)
    if model.projected:
        return _crowded(model, poisson)
    return _locked(reproduced, poisson)


def _locked(reproduced: int, poisson: float) -> str | None:
    """Volumes that are resisted in every point."""
    pressure = _figure(PRESSURE[min(reproduced, 4)], poisson)
    if pressure <= TOLD or reproduced > max(PRESSURE):
        return None
    names = {1: "covers of degree 0 lock", 2: "covers that hold quadratic fields lock"}
    name = names.get(reproduced, "covers lock")
    off = f"pressures in the stress of elements are about {pressure:.2g} % off"
    if reproduced in SHORT:
        off += f" and displacements up to {_figure(SHORT[reproduced], poisson):.2g} % too small"
    better = 'use volumetric = "projected" in [cover]'
    more = " with degree 1 or 2" if reproduced == 1 else ""
    return f"{name} in plane strain at a Poisson ratio of {poisson:.7g}: {off}; {better}{more}"


def _parted(model: "Model", poisson: float) -> str | None:
    """Blocks that are divided and glued: each keeps its volume by itself."""
    degree = model.manifold.degree
    divided = np.bincount(model.manifold.element_region, minlength=1).max() > 1
    if not divided or degree > 2 or (degree == 2 and model.projected):
        return None
    off, better = "5 % or more", 'use volumetric = "projected" in [cover]'
    if degree < 2:
        off, better = "45 to 75 %", 'use degree 2 and volumetric = "projected" in [cover]'
    return (
        f"sub-blocks of degree {degree} lock in plane strain at a Poisson ratio of {poisson:.7g}: "
        f"displacements are {off} too small; {better}"
    )


def _crowded(model: "Model", poisson: float) -> str | None:
    """Pressures on covers of degree 0, as many as half the unknowns."""
    assert model.pressures is not None
    if len(model.pressures) < CROWDED * model.manifold.n_unknowns:
        return None
    return (
        f"pressures on covers of degree 0 oscillate at a Poisson ratio of {poisson:.7g}: in the "
        "stress of elements they are 10 to 120 % off, displacements up to 18 % too small; use "
        "degree 1 or 2 in [cover]"
    )


def _figure(known: tuple[float, ...], poisson: float) -> float:
    """Read a table at a Poisson ratio, between its decades evenly in the logarithm."""
    decade = -np.log10(max(1 - 2 * poisson, 1e-15))
    return float(10 ** np.interp(decade, DECADES, np.log10(known)))
