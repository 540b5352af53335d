"""The effect: steady flow in joints; pressure opens them, which lets more water through."""

from typing import Self

from nmm.effects.base import Setup
from nmm.errors import Fault, SceneError
from nmm.water.joints.joint_water import JointWater


class JointFlow(JointWater):
    """Steady flow in the joints of a scene."""

    name = "joint flow"

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """See `JointWater.from_setup`; joints that are connected to no given head are refused."""
        found = super().from_setup(setup)
        found._refuse_isolated(setup)
        return found

    def _refuse_isolated(self, setup: Setup) -> None:
        """Refuse joints that are connected to no given head in the reference configuration."""
        conductance = self.network.conductance(self.apertures(setup.start))
        lost = self.network.isolated(conductance, self.given(setup.start.time)[0])
        if lost.any():
            x, y = self.sites.places[lost][0] + setup.origin
            found = f"{int(lost.sum())} ends of joints that no head reaches, at ({x:.6g}, {y:.6g})"
            expected = "a head in every part of the joints that are open to one another"
            place = setup.scene.source.place("joint_flow")
            raise SceneError(Fault(place, found, expected, "add [[joint_heads]] there"))
