"""Water in the joints of a scene: apertures, heads and pressures.

The heads of `JointWater` are those of steady flow with the apertures at the start of a step.
Statics repeats steps until nothing moves any more: a fixed-point iteration on apertures and heads.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.kept import forget_kept, kept, kept_of_place, place_and_time
from nmm.assembly.state import State
from nmm.constraints.ties.shared_edges import shared_edges
from nmm.diffusion.edges import Factor
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.load_factor import course_of, steadily
from nmm.errors import Fault, SceneError, SolveError
from nmm.quantity import Quantity
from nmm.water.joints.network import JointNetwork
from nmm.water.joints.wet_joints import NEAR, WetJoints


@dataclass(frozen=True)
class PrescribedHead:
    """A prescribed head (k,) (m) at nodes (k,) of the network, and its factor."""

    name: str
    nodes: Ints
    head: Floats
    factor: Factor


class JointWater(Effect):
    """Base of the effects of water in joints.

    Parameters
    ----------
    sites, network
        The joints as places, and as a network.
    aperture, least
        Initial and residual apertures (j,) (m).
    prescribed
        Prescribed heads; later ones overwrite earlier ones.
    weight
        Unit weight of water (N/m3).
    n_unknowns
        Number of unknowns of the model.
    """

    external = False

    def __init__(
        self,
        sites: WetJoints,
        network: JointNetwork,
        aperture: tuple[Floats, Floats],
        prescribed: list[PrescribedHead],
        weight: float,
        n_unknowns: int,
    ) -> None:
        self.sites, self.network, self.prescribed = sites, network, prescribed
        self._initial, self._residual = aperture
        self.weight, self.n_unknowns = weight, n_unknowns
        self._courses_rest = all(one.factor is steadily for one in prescribed)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[joint_flow]``, ``[[joint_heads]]`` and the interfaces' apertures."""
        scene, model = setup.scene, setup.model
        assert scene.joint_flow is not None
        joints = shared_edges(model)
        initial, residual = _apertures(setup, joints.edge_a, joints.edge_b)
        wet = ~np.isnan(initial)
        if not wet.any():
            place = scene.source.place("joint_flow")
            expected = "blocks that share an edge, with an interface that has an aperture"
            raise SceneError(Fault(place, "no joint", expected, "add aperture to the interface"))
        sites = WetJoints.of(model, joints.take(wet))
        weight = scene.joint_flow.unit_weight
        mobility = weight / (12 * scene.joint_flow.viscosity)
        length = sites.joints.length
        network = JointNetwork(sites.nodes, length, len(sites.places), mobility)
        prescribed = _prescribed(setup, sites)
        aperture, n_unknowns = (initial[wet], residual[wet]), model.manifold.n_unknowns
        return cls(sites, network, aperture, prescribed, weight, n_unknowns)

    @property
    def about(self) -> str:
        return f"{len(self.network.length)} joints between {self.network.n} nodes"

    @property
    def steady(self) -> bool:
        return self._courses_rest

    def apertures(self, state: State) -> Floats:
        """Apertures (j, 2) at the ends of the joints (m)."""
        return np.maximum(self._initial[:, None] + self._opening(state), self._residual[:, None])

    @kept_of_place
    def _opening(self, state: State) -> Floats:
        return self.sites.opening(state)

    def heads(self, state: State, time: float) -> Floats:
        """Heads (n,) of the nodes with the apertures of a state (m); nan where no joint is open."""
        return self._steady_heads(state, 0.0 if self.steady else time)

    @kept(place_and_time)
    def _steady_heads(self, state: State, time: float) -> Floats:
        nodes, given = self.given(time)
        conductance = self.network.conductance(self.apertures(state))
        try:
            return self.network.heads(conductance, nodes, given)
        except SolveError as fault:
            lost = self.network.isolated(conductance, nodes)
            x, y = self.sites.places[lost][0]
            raise SolveError(f"joint flow: at ({x:.6g}, {y:.6g}): {fault}") from fault

    def pressures(self, state: State, time: float) -> Floats:
        """Pressures (n,) at the nodes (Pa); zero above the water table and at closed joints."""
        depth = np.nan_to_num(self.heads(state, time) - self.sites.places[:, 1])
        return np.asarray(self.weight * np.maximum(depth, 0.0))

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n_unknowns,) of the pressure on both faces, in axes of bodies."""
        forces = self._forces(state, end.time)
        if not forces.any():
            return np.zeros(self.n_unknowns)
        return self.sites.interface.spread(state, forces)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of the forces at both ends on the relative motion of the faces."""
        forces, motion = self._forces, self.sites.interface.motion
        mean = (forces(before, before.time) + forces(after, after.time)) / 2
        return float(np.sum(mean * (motion(after) - motion(before)))) if mean.any() else 0.0

    def history(self, state: State) -> Mapping[str, float]:
        """Return inflows (m3/s) at prescribed heads, the largest pressure (Pa) and aperture (m)."""
        heads, aperture = self.heads(state, state.time), self.apertures(state)
        inflow = self.network.inflow(self.network.conductance(aperture), heads)
        thick = self.sites.interface.area.sum() / self.sites.joints.length.sum()
        found = {
            f"inflow:{one.name}": float(thick * inflow[one.nodes].sum()) for one in self.prescribed
        }
        pressure = float(self.pressures(state, state.time).max())
        return {**found, "pressure": pressure, "aperture": float(aperture.max())}

    def outputs(self, state: State) -> Mapping[str, Quantity]:
        """Return pressures at the corners of blocks where joints end, zero at other vertices."""
        pressure = self.pressures(state, state.time)
        found = np.where(self.sites.corner >= 0, pressure[self.sites.corner], 0.0)
        return {"pressure": Quantity("points", found[:, None], "Pa", ("joints",))}

    def given(self, time: float) -> tuple[Ints, Floats]:
        """Nodes (k,) with a prescribed head, and the heads (k,) (m); later tables count."""
        return self._given_at(0.0 if self._courses_rest else time)

    @kept(lambda water, time: time)
    def _given_at(self, time: float) -> tuple[Ints, Floats]:
        heads = np.full(self.network.n, np.nan)
        for one in self.prescribed:  # a handful
            heads[one.nodes] = one.factor(time) * one.head
        nodes = np.flatnonzero(~np.isnan(heads))
        return nodes, heads[nodes]

    def forget(self) -> None:
        forget_kept(self)

    def _forces(self, state: State, time: float) -> Floats:
        """Forces (m, 2) on the first sides of the joints (N)."""
        return self._forces_of_pressure(state, 0.0 if self.steady else time)

    @kept(place_and_time)
    def _forces_of_pressure(self, state: State, time: float) -> Floats:
        pressure = self.pressures(state, time)
        if not pressure.any():
            return np.zeros((len(self.sites.interface), 2))
        return self.sites.forces(state, pressure[self.sites.nodes])


def _apertures(setup: Setup, edge_a: Ints, edge_b: Ints) -> tuple[Floats, Floats]:
    """Initial and residual apertures (j,) (m); nan for joints without flow."""
    manifold, materials = setup.model.manifold, list(setup.scene.materials)
    one, other = (
        manifold.element_region[manifold.boundary.element[edge]] for edge in (edge_a, edge_b)
    )
    pairs = np.stack([setup.region_material[one], setup.region_material[other]], axis=1)
    initial, residual = np.full(len(pairs), np.nan), np.zeros(len(pairs))
    for a, b in np.unique(pairs, axis=0).tolist():  # pairs of materials
        try:
            interface = setup.scene.interface(materials[a], materials[b])
        except SceneError:
            continue
        chosen: Bools = (pairs == (a, b)).all(axis=1) & (one != other)
        if interface.aperture is not None:
            initial[chosen], residual[chosen] = (
                interface.aperture,
                interface.residual_aperture or 0.0,
            )
    return initial, residual


def _prescribed(setup: Setup, sites: WetJoints) -> list[PrescribedHead]:
    near = NEAR * setup.model.manifold.elements.extent
    found = []
    for item in setup.scene.joint_heads:  # a handful
        ends = np.array([item.point, item.point] if item.segment is None else item.segment)
        nodes = np.flatnonzero(_distance(sites.places, ends) <= near)
        if not len(nodes):
            place = setup.scene.source.of_name("joint_heads", item.name)
            shown, expected = str(item.segment or item.point), "a place where a joint ends"
            raise SceneError(Fault(place, shown, expected, "move it to the end of a joint"))
        head = np.full(len(nodes), item.head - setup.origin[1])
        found.append(PrescribedHead(item.name, nodes, head, course_of(item.history)))
    return found


def _distance(points: Floats, ends: Floats) -> Floats:
    """Distance (m,) of points (m, 2) from a segment (2, 2), which may be a point."""
    way = ends[1] - ends[0]
    size = float(way @ way)
    share = np.clip((points - ends[0]) @ way / size, 0, 1) if size else np.zeros(len(points))
    return np.asarray(np.hypot(*(points - ends[0] - share[:, None] * way).T))
