"""Sound scenes of what acts on bodies and in them, one table or more of every effect among them."""

from nmm.verification.hard.spoilt.sound_actions import LOADED, MEMBERS, ROLLED_OVER, SHAKEN, STAGED
from nmm.verification.hard.spoilt.sound_bonds import (
    GROWING,
    OPENED,
    PULLED,
    SOFTENING,
    SPLITTING,
    ZONES,
)
from nmm.verification.hard.spoilt.sound_fields import (
    CONSOLIDATING,
    FILLING,
    HEATED,
    JOINTS_UNDER_WATER,
    SEEPING,
)
from nmm.verification.hard.spoilt.sound_matter import CREEPING, YIELDING

EFFECTS = {
    **{"shaken": SHAKEN, "members": MEMBERS, "loaded": LOADED, "heated": HEATED},
    **{"seeping": SEEPING, "joints under water": JOINTS_UNDER_WATER, "softening": SOFTENING},
    **{"filling": FILLING, "consolidating": CONSOLIDATING},
    **{
        "pulled": PULLED,
        "opened": OPENED,
        "growing": GROWING,
        "zones": ZONES,
        "splitting": SPLITTING,
        "staged": STAGED,
        "yielding": YIELDING,
    },
    **{"creeping": CREEPING, "rolled over": ROLLED_OVER},
}
"""Scenes by name."""
