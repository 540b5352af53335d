"""An interface of a scene as a law."""

from typing import Any

import numpy as np

from nmm.errors import SceneError
from nmm.interfaces.base import INTERFACE_LAWS, InterfaceLaw
from nmm.interfaces.restitution import damping_of

# Keys of a scene's interface that every law has, and those that a law need not know.
ALWAYS = (
    "friction_angle",
    "cohesion",
    "tensile_strength",
    "bonded",
    "normal_stiffness",
    "shear_stiffness",
    "fracture_energy",
)
WHERE_GIVEN = (
    "shear_fracture_energy",
    "residual_friction_angle",
    "dilation_angle",
    "dilation_slip",
    "damping",
)


def interface_law(item: Any) -> InterfaceLaw:
    """Return the law of a scene's interface: with a fracture energy its softened form, if any.

    Raises
    ------
    SceneError
        Limits or springs that no contact can have.
    """
    softened = vars(INTERFACE_LAWS.load(item.law)).get("softened")
    meant = item.law if item.fracture_energy is None else softened or item.law
    given = {name: getattr(item, name) for name in ALWAYS}
    for name in WHERE_GIVEN:
        if getattr(item, name) is not None:
            given[name] = getattr(item, name)
    if item.restitution is not None:
        given["damping"] = damping_of(item.restitution)
    law: InterfaceLaw = INTERFACE_LAWS.make(meant, item.options, **given)
    _refuse_unsound(law)
    return law


def _refuse_unsound(law: InterfaceLaw) -> None:
    """Refuse a law that answers a bond and a contact by anything but one number each, not below 0.

    Limits alone may be infinite, but for friction's.
    """
    history = law.initial(np.array([law.bonded, False]))
    found = law.response(history, np.full(2, law.normal_stiffness or 1e12))
    limits = {name: np.asarray(column) for name, column in vars(found.limits).items()}
    for name, column in {**limits, "open_share": found.open_share, "rise": found.rise}.items():
        endless = name in ("tension", "cohesion")
        if np.shape(column) != (2,) or not ((column >= 0) & (endless | np.isfinite(column))).all():
            raise SceneError(
                f"law {type(law).__name__}: {name} of a bond and of a contact: {column}: expected "
                "one number each, not negative: correct the constants, or InterfaceLaw.response"
            )
