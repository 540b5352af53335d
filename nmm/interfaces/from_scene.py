"""An interface of a scene as a law."""

from typing import Any

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
    """Return the law of a scene's interface: with a fracture energy the common one softens."""
    softens = item.law == "mohr_coulomb" and item.fracture_energy is not None
    given = {name: getattr(item, name) for name in ALWAYS}
    for name in WHERE_GIVEN:
        if getattr(item, name) is not None:
            given[name] = getattr(item, name)
    if item.restitution is not None:
        given["damping"] = damping_of(item.restitution)
    name = "linear_softening" if softens else item.law
    law: InterfaceLaw = INTERFACE_LAWS.make(name, item.options, **given)
    return law
