"""What every strength of blocks that split is held to."""

import numpy as np

from integration.arrays import Floats
from nmm.splitting.strength import BlockStrength, SplitJudgement
from nmm.testing.claims import claim, close, finite

# Of angles and shares of strength: rounding of a square root.
EXACT = 1e-10


def check_strength(
    strength: BlockStrength, unit: float = 1e6, seed: int = 0, number: int = 200
) -> None:
    """Hold a strength to what every one promises.

    Its use is finite and not negative, none without stress, and no less the further a stress has
    grown; planes turn with the stress and are mirrored with it; blocks know nothing of each other.
    Stresses are random, of the size of ``unit`` (Pa).

    Raises
    ------
    AssertionError
        Saying what is not kept and by how much.
    """
    rng = np.random.default_rng(seed)
    stress = unit * rng.normal(size=(number, 3))
    found = strength.judged(stress)
    finite("use of strength", found.use)
    finite("first planes", found.planes[:, 0])
    claim(bool((found.use >= 0).all()), "a use of strength below zero")
    close("use of strength without stress", strength.judged(np.zeros((1, 3))).use, 0.0, EXACT)
    grown = strength.judged(1.5 * stress)
    least = float((grown.use - found.use).min())
    claim(least >= -EXACT, f"a stress that grows uses {-least:.3g} less of the strength")
    angle = rng.uniform(-np.pi, np.pi, number)
    turned = strength.judged(_turned(stress, angle))
    close("use of a turned stress", turned.use, found.use, EXACT * (1 + found.use.max()))
    _same_planes("planes of a turned stress", turned, found.planes + angle[:, None])
    mirrored = strength.judged(stress * [1, 1, -1])
    _same_planes("planes of a mirrored stress", mirrored, -found.planes)
    order = rng.permutation(number)
    mixed = strength.judged(stress[order])
    close("use of blocks in another order", mixed.use, found.use[order], EXACT)


def _turned(stress: Floats, angle: Floats) -> Floats:
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    tensor = np.array([[stress[:, 0], stress[:, 2]], [stress[:, 2], stress[:, 1]]])
    found = np.einsum("ijm,jkm,lkm->ilm", turn, tensor, turn)
    return np.stack([found[0, 0], found[1, 1], found[0, 1]], axis=1)


def _same_planes(what: str, found: SplitJudgement, expected: Floats) -> None:
    """Claim that planes are the same, in any order: no plane has a sense."""
    one, other = (_sums(planes) for planes in (found.planes, expected))
    close(what, one, other, 1e-7)  # of stresses nearly alike in all directions


def _sums(planes: Floats) -> Floats:
    """Sums over the planes of the doubled direction, which know neither sense nor order."""
    return np.stack([np.nansum(np.cos(2 * planes), axis=1), np.nansum(np.sin(2 * planes), axis=1)])
