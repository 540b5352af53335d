"""Water that flows in the joints below a dam and opens the joint below a block."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from nmm.verification import text
from nmm.verification.base import Case, Check, Checks, SceneCase, limit
from nmm.water.joints.network import JointNetwork

if TYPE_CHECKING:
    from nmm.stepping.run import Run
    from nmm.water.joints.steady_flow import JointFlow
    from nmm.water.joints.storage import JointStorage

FLOW = "[joint_flow]\n"
SMALL = "contact presses blocks by micrometres, joints are open by tenths of a millimetre"


def joint_head(name: str, point: tuple[float, float], head: float) -> str:
    """Table of a head at the end of a joint."""
    return f'[[joint_heads]]\nname = "{name}"\npoint = {list(point)}\nhead = {head!r}\n'


def joint(name: str, between: tuple[str, str], more: str) -> str:
    """Table of an interface of 45 degrees of friction."""
    return text.interface(name, 45.0, between) + more + "\n"


class UpliftByFlow(SceneCase):
    """Below a dam water flows from 28 m of head to none; the joint is wider after 8 m."""

    name, title = "WA4", "Uplift below a dam by flow in its joint"
    source = "Joints in series: 5.6 m of head after 8 m, uplift 1757952 N/m, q = 1.8312e-5 m2/s"
    formulations = ("cone", "lagrange")

    def scene(self) -> str:
        """Return a dam of 24 m on two held blocks."""
        return text.scene(
            'title = "Uplift by flow"\nplane = "strain"\n[gravity]\n[contact]\n' + FLOW,
            [
                text.material("concrete", 30e9, 0.2, 2400.0),
                text.material("tight", 30e9, 0.2, 2400.0),
                text.material("wide", 30e9, 0.2, 2400.0),
                joint("first", ("concrete", "tight"), "aperture = 0.2e-3"),
                joint("second", ("concrete", "wide"), "aperture = 0.4e-3"),
                joint("rock", ("tight", "wide"), ""),
                text.box("dam", (0, 0), (24, 15), "concrete"),
                text.box("heel", (0, -10), (8, 10), "tight"),
                text.box("toe", (8, -10), (16, 10), "wide"),
                text.fixed_block("heel"),
                text.fixed_block("toe"),
                joint_head("reservoir", (0.0, 0.0), 28.0),
                joint_head("tail", (24.0, 0.0), 0.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        flow: JointFlow = run.stepper.plan.effects["joint flow"]  # type: ignore[assignment]
        heads = flow.heads(run.state, run.state.time)
        places = flow.sites.places
        middle = float(heads[np.argmin(np.hypot(*(places - [8.0, 0.0]).T))])
        last = run.frames[-1]
        base = (np.abs(last.contact_position[:, 1]) < 0.01) & (
            np.abs(last.contact_normal[:, 1]) > 0.9
        )
        normal = -float(last.contact_force[base, 0].sum())
        weight = 24 * 15 * 2400 * 9.81
        return {
            "head after 8 m (m)": Check(middle, 5.6, 1e-3, SMALL),
            "flow (m2/s)": Check(
                run.history["joint flow:inflow:reservoir"][-1], 1.8312e-5, 1e-3, SMALL
            ),
            "uplift (N/m)": Check(weight - normal, 1757952.0, 1e-3, SMALL),
        }


@dataclass(frozen=True)
class LiftedBlock(SceneCase):
    """Water under a block on a joint with a spring opens it by what it takes off the joint."""

    name = "WA5"
    title = "A joint that its water opens"
    source = "w = w0 - (W - U) / (k_n L), U = w h L, W = 1 MN/m on 4 m"
    formulations = ("dda",)
    stiffness: float = 1e10

    def scene(self) -> str:
        """Return a block on a held floor under 20 m of head."""
        more = f"aperture = 0.2e-3\nnormal_stiffness = {self.stiffness!r}\n"
        return text.scene(
            'title = "Lifted"\nplane = "strain"\n[gravity]\n[contact]\n' + FLOW,
            [
                text.material("rock", 50e12, 0.2, 1e6 / (9.81 * 4 * 2)),
                joint("joint", ("rock", "rock"), more + f"shear_stiffness = {self.stiffness!r}"),
                text.box("block", (0, 0), (4, 2), "rock"),
                text.box("floor", (0, -2), (4, 2), "rock"),
                text.fixed_block("floor"),
                joint_head("left", (0.0, 0.0), 20.0),
                joint_head("right", (4.0, 0.0), 20.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        aperture = run.history["joint flow:aperture"][-1]
        exact = 0.2e-3 - (1e6 - 9810 * 20 * 4) / (self.stiffness * 4)
        return {
            "aperture (m)": Check(aperture, exact, 1e-6, "the blocks are 5000 times stiffer"),
            "pressure (Pa)": Check(run.history["joint flow:pressure"][-1], 196200.0, 1e-9, "given"),
        }


class JointBridge(Case):
    """Five joints between a reservoir and an outlet, joined as a bridge of resistances."""

    name = "WA3"
    title = "Heads and flows in a bridge of five joints"
    source = "Kirchhoff's rules: h = 205/27 and 65/27 m of 10 m, cubic law"

    def checks(self, formulation: str) -> Checks:
        """Solve the network with nodes in two orders; compare heads and flows."""
        ends = np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]])
        length = np.array([1.0, 1.0, 1.5, 1.0, 1.0])
        aperture = np.repeat(np.array([0.2, 0.1, 0.15, 0.1, 0.2])[:, None] * 1e-3, 2, axis=1)
        flows = (1.574444e-5, 6.206944e-6, 9.5375e-6, 6.206944e-6, 1.574444e-5)
        checks = {}
        for order in ([0, 1, 2, 3], [3, 1, 0, 2]):
            node = np.array(order)
            network = JointNetwork(node[ends], length, 4)
            conductance = network.conductance(aperture)
            heads = network.heads(conductance, node[[0, 3]], np.array([10.0, 0.0]))
            said = "as drawn" if order[0] == 0 else "in another order"
            for name, place, known in (("B", 1, 205 / 27), ("C", 2, 65 / 27)):
                checks[f"head at {name}, nodes {said} (m)"] = Check(
                    float(heads[node[place]]), known, 1e-12, "rounding"
                )
            found = network.flows(conductance, heads)
            inflow = float(network.inflow(conductance, heads)[node[0]])
            off = float(np.abs(found / flows - 1).max())
            checks[f"flows off, nodes {said}"] = limit(off, 1e-6, "digits of the table")
            checks[f"inflow, nodes {said} (m2/s)"] = Check(
                inflow, 2.195138889e-5, 1e-9, "digits of the table"
            )
        return checks


@dataclass(frozen=True)
class PressureInJoint(SceneCase):
    """A joint whose far end is closed fills from one that is pressed: it opens and lets more in."""

    name = "WA6"
    title = "Pressure that spreads along a joint"
    source = "S p' = w^3 / (12 mu) p'', S = w / K + 1 / k_n: the series of a slab"
    formulations = ("dda",)
    aperture = 1e-4
    length = 20.0
    stiffness = 1e10
    blocks = 20
    time: float = 0.3
    exact: tuple[float, float] = (0.39319618, 0.57015747)
    label = "t D / L^2 = {0.time:g}"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return three times, with the pressures at the closed end and half way."""
        known = {0.1: (0.05069464, 0.26434868), 0.3: cls.exact, 1.0: (0.89202296, 0.92364870)}
        return [cls(time, exact) for time, exact in known.items()]

    def scene(self) -> str:
        """Return a row of stiff blocks on a floor, held by the joint's springs alone."""
        storage = self.aperture / 2.2e9 + 1 / self.stiffness
        diffusivity = self.aperture**3 / 12e-3 / storage
        wide, duration = self.length / self.blocks, self.time * self.length**2 / diffusivity
        return text.scene(
            'title = "Joint that fills"\nplane = "strain"\n[contact]\n[joint_flow]\n'
            f"transient = true\ninitial = 0.0\nduration = {duration!r}\n"
            "[formulation.loading]\nincrement = 0.025\n"
            '[formulation.supports]\nmethod = "penalty"\n',
            [
                text.material("top", 1e15, 0.0, None),
                text.material("low", 1e15, 0.0, None),
                joint(
                    "wet",
                    ("top", "low"),
                    "bonded = true\ncohesion = 1e9\ntensile_strength = 1e9\n"
                    f"normal_stiffness = {self.stiffness!r}\n"
                    f"shear_stiffness = {self.stiffness!r}\naperture = {self.aperture!r}",
                ),
                text.interface("dry", 0.0, ("top", "top")),
                text.box("floor", (0, -1), (self.length, 1), "low"),
                *(text.box(f"b{i}", (i * wide, 0), (wide, 1), "top") for i in range(self.blocks)),
                text.fixed_block("floor"),
                joint_head("pump", (0.0, 0.0), 1e3 / 9810),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        flow: JointStorage = run.stepper.plan.effects["transient joint flow"]  # type: ignore[assignment]
        place = flow.sites.places[:, 0]
        found = flow.pressures(run.state, run.state.time) / 1e3
        ends = [int(np.argmin(np.abs(place - at))) for at in (self.length, self.length / 2)]
        reason = "of order 1 in forty increments; the published tolerance"
        far, middle = (float(found[node]) for node in ends)
        return {
            "pressure at the closed end": Check(far, self.exact[0], 0.01, reason, scale=1.0),
            "pressure half way": Check(middle, self.exact[1], 0.01, reason, scale=1.0),
        }
