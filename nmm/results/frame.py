"""What a run hands over: the topology of its elements once, then one frame an output time."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.quantity import Quantity


@dataclass(frozen=True)
class Topology:
    """The elements that the points and stresses of frames belong to.

    Attributes
    ----------
    elements
        Manifold elements in reference coordinates, m; (E,) polygons, (P,) points.
    element_region
        (E,) index of the input region (block) that each element belongs to.
    region_material
        (N,) index into `material_names` of each region.
    material_names
        Names of the materials in the order of the scene.
    region_names
        (N,) names of the regions; empty when they have none.
    """

    elements: Polygons
    element_region: Ints
    region_material: Ints
    material_names: tuple[str, ...]
    region_names: tuple[str, ...] = ()

    @property
    def element_material(self) -> Ints:
        """(E,) index of the material of each element."""
        return self.region_material[self.element_region]


@dataclass(frozen=True)
class Frame:
    """The state of a run at one output time.

    Attributes
    ----------
    index
        Number of the frame, counted from 0.
    time
        Time, s; in statics without a clock the load factor may stand here.
    load_factor
        Factor on the scaled loads.
    stage
        "load", "dynamic" or "failure".
    points
        (P, 2) current coordinates of the points of `Topology.elements`, m.
    displacement, velocity
        (P, 2) at the same points, m and m/s.
    stress
        (E, 3) mean Cauchy stress (xx, yy, xy) of each element, Pa, tension positive.
    contact_position
        (C, 2) current position of each contact point, m.
    contact_normal
        (C, 2) unit normal from side b (edge) to side a (vertex).
    contact_length
        (C,) tributary length of each contact point, m.
    contact_force
        (C, 2) normal and shear force, N, tension positive.
    contact_gap
        (C,) signed gap, m, positive open.
    contact_state
        (C,) values of `nmm.contact.problem.contact_state.ContactState`.
    topology
        Which of the run's topologies the points belong to; sinks set it.
    fields
        Further quantities by name, as effects of the scene and its ``[output]`` declare them;
        those of bodies are given for each element.
    """

    index: int
    time: float
    load_factor: float
    stage: str
    points: Floats
    displacement: Floats
    velocity: Floats
    stress: Floats
    contact_position: Floats
    contact_normal: Floats
    contact_length: Floats
    contact_force: Floats
    contact_gap: Floats
    contact_state: Ints
    topology: int = 0
    fields: Mapping[str, Quantity] = field(default_factory=dict)

    def on(self, place: str) -> dict[str, Quantity]:
        """Return the further quantities that belong to one of `nmm.quantity.PLACES`."""
        return {name: one for name, one in self.fields.items() if one.on == place}
