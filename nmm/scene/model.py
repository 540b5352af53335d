"""The scene: what happens, independent of the approximation. SI units, angles in radians."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, Self

from pydantic import (
    Field,
    ModelWrapValidatorHandler,
    PrivateAttr,
    ValidationError,
    field_validator,
    model_validator,
)

from nmm.errors import Fault, SceneError
from nmm.formulation import Formulation
from nmm.scene.actions import (
    ContactTable,
    GravityTable,
    InertiaTable,
    PlacedTable,
    SupportTable,
)
from nmm.scene.details import again, detail
from nmm.scene.faults import Source
from nmm.scene.fields import Count, Frozen, Length, TableName, Text, Time, example, fault
from nmm.scene.matter.interfaces import InterfaceTable
from nmm.scene.matter.materials import Material
from nmm.scene.monitors import MonitorTable, ReferenceTable
from nmm.scene.output import OutputTable
from nmm.scene.own_tables import EffectTable
from nmm.scene.rules.contradictions import contradictions
from nmm.scene.solids import Block, Crack, JointSet, Tessellation
from nmm.scene.stages import StageTable
from nmm.scene.tables.bars import BarTable
from nmm.scene.tables.fracture.cohesive import CohesiveZonesTable
from nmm.scene.tables.fracture.table import FractureTable
from nmm.scene.tables.heat import (
    ConvectionTable,
    HeatFluxTable,
    HeatSourceTable,
    HeatTable,
    TemperatureTable,
)
from nmm.scene.tables.initial import InitialStressTable, InitialVelocityTable
from nmm.scene.tables.joint_flow import JointFlowTable, JointHeadTable
from nmm.scene.tables.loading.fields import FieldTable
from nmm.scene.tables.loading.growth import Loading
from nmm.scene.tables.loading.loads import LoadTable
from nmm.scene.tables.members import (
    DashpotTable,
    FoundationTable,
    MassTable,
    SpringTable,
)
from nmm.scene.tables.seepage import HeadTable, InflowTable, SeepageTable
from nmm.scene.tables.shaking.boundaries import FreeFieldTable, ViscousBoundaryTable
from nmm.scene.tables.shaking.damping import DampingTable
from nmm.scene.tables.shaking.records import RecordTable
from nmm.scene.tables.splitting import SplittingTable
from nmm.scene.tables.strength_reduction import StrengthReductionTable
from nmm.scene.tables.water import WaterPressureTable


class Scene(Frozen):
    """What happens: geometry, materials, joints, supports, loads, effects, duration.

    Notes
    -----
    A scene that exists is consistent: names refer to something, and named effects have what they
    need. Its blocks are checked by `nmm.geometry.regions`.
    """

    title: Text = Field(default="", description="a title", examples=["beam"])
    plane: Literal["stress", "strain"] = Field(
        description='"stress" or "strain"', examples=["strain"]
    )
    thickness: Length = Field(
        default=1.0, gt=0, description="a thickness in m, > 0", examples=["100 mm"]
    )
    duration: Time | None = Field(
        default=None, gt=0, description="a duration in s, > 0", examples=example("s")
    )
    seed: Count = Field(default=0, ge=0, description="a seed, an integer >= 0", examples=[1])
    materials: dict[TableName, Material] = Field(
        min_length=1, description="at least one table [materials.NAME]"
    )
    interfaces: dict[TableName, InterfaceTable] = Field(
        default={}, description="tables [interfaces.NAME]"
    )
    blocks: tuple[Block, ...] = Field(default=(), description="tables [[blocks]]")
    tessellations: tuple[Tessellation, ...] = Field(
        default=(), description="tables [[tessellations]]"
    )
    joint_sets: tuple[JointSet, ...] = Field(default=(), description="tables [[joint_sets]]")
    cracks: tuple[Crack, ...] = Field(default=(), description="tables [[cracks]]")
    records: dict[TableName, RecordTable] = Field(
        default={}, description="tables [records.NAME] of motions over time"
    )
    fields: dict[TableName, FieldTable] = Field(
        default={}, description="tables [fields.NAME] of values over places and times"
    )
    supports: tuple[SupportTable, ...] = Field(default=(), description="tables [[supports]]")
    loads: tuple[LoadTable, ...] = Field(default=(), description="tables [[loads]]")
    viscous_boundaries: tuple[ViscousBoundaryTable, ...] = Field(
        default=(), description="tables [[viscous_boundaries]]"
    )
    free_fields: tuple[FreeFieldTable, ...] = Field(
        default=(), description="tables [[free_fields]]"
    )
    gravity: GravityTable | None = Field(default=None, description="a table [gravity]")
    inertia: InertiaTable | None = Field(default=None, description="a table [inertia]")
    springs: tuple[SpringTable, ...] = Field(default=(), description="tables [[springs]]")
    dashpots: tuple[DashpotTable, ...] = Field(default=(), description="tables [[dashpots]]")
    bars: tuple[BarTable, ...] = Field(default=(), description="tables [[bars]]")
    foundations: tuple[FoundationTable, ...] = Field(
        default=(), description="tables [[foundations]]"
    )
    masses: tuple[MassTable, ...] = Field(default=(), description="tables [[masses]]")
    damping: DampingTable | None = Field(default=None, description="a table [damping]")
    splitting: dict[TableName, SplittingTable] = Field(
        default={}, description="tables [splitting.MATERIAL]"
    )
    contact: ContactTable | None = Field(default=None, description="a table [contact]")
    fracture: FractureTable | None = Field(default=None, description="a table [fracture]")
    cohesive_zones: CohesiveZonesTable | None = Field(
        default=None, description="a table [cohesive_zones]"
    )
    strength_reduction: StrengthReductionTable | None = Field(
        default=None, description="a table [strength_reduction]"
    )
    loading: Loading | None = Field(default=None, description="a table [loading]")
    initial_velocities: tuple[InitialVelocityTable, ...] = Field(
        default=(), description="tables [[initial_velocities]]"
    )
    initial_stresses: tuple[InitialStressTable, ...] = Field(
        default=(), description="tables [[initial_stresses]]"
    )
    heat: HeatTable | None = Field(default=None, description="a table [heat]")
    seepage: SeepageTable | None = Field(default=None, description="a table [seepage]")
    heads: tuple[HeadTable, ...] = Field(default=(), description="tables [[heads]]")
    inflows: tuple[InflowTable, ...] = Field(default=(), description="tables [[inflows]]")
    joint_flow: JointFlowTable | None = Field(default=None, description="a table [joint_flow]")
    joint_heads: tuple[JointHeadTable, ...] = Field(
        default=(), description="tables [[joint_heads]]"
    )
    water_pressures: tuple[WaterPressureTable, ...] = Field(
        default=(), description="tables [[water_pressures]]"
    )
    temperatures: tuple[TemperatureTable, ...] = Field(
        default=(), description="tables [[temperatures]]"
    )
    heat_fluxes: tuple[HeatFluxTable, ...] = Field(default=(), description="tables [[heat_fluxes]]")
    heat_sources: tuple[HeatSourceTable, ...] = Field(
        default=(), description="tables [[heat_sources]]"
    )
    convections: tuple[ConvectionTable, ...] = Field(
        default=(), description="tables [[convections]]"
    )
    effects: dict[TableName, EffectTable] = Field(
        default={}, description="tables [effects.NAME] of effects of one's own"
    )
    monitors: tuple[MonitorTable, ...] = Field(default=(), description="tables [[monitors]]")
    stages: tuple[StageTable, ...] = Field(default=(), description="tables [[stages]]")
    output: OutputTable | None = Field(default=None, description="a table [output]")
    references: tuple[ReferenceTable, ...] = Field(
        default=(), alias="reference", description="tables [[reference]]"
    )
    formulation: Formulation | None = Field(default=None, description="a table [formulation]")

    _source: Source = PrivateAttr(default_factory=Source)

    @property
    def in_time(self) -> bool:
        """Whether time passes: with inertia, or quasi-statically over a duration."""
        passing = self.duration is not None and self.loading is None
        return self.inertia is not None or passing or any(one.duration for one in self.stages)

    @property
    def followed(self) -> bool:
        """Whether a field of the blocks is transient."""
        return any(
            field is not None and field.transient
            for field in (self.heat, self.seepage, self.joint_flow)
        )

    @property
    def steady(self) -> bool:
        """Whether no action changes with the load factor or with a history."""
        given = (getattr(self, name) for name in type(self).model_fields)
        tables = (one for listed in given if isinstance(listed, tuple | list) for one in listed)
        acts = [one for one in tables if isinstance(one, PlacedTable)]
        changes = (one.history or getattr(one, "field", None) for one in acts)
        return not (self.loads or self.water_pressures or any(changes))

    @property
    def source(self) -> Source:
        """Source of the scene; `scene.source.place("blocks", 3)` is "file:line: blocks.3"."""
        return self._source

    def interface(self, first: str, second: str) -> InterfaceTable:
        """Return the interface between two materials: that of the pair, else of `between = "any"`.

        Raises
        ------
        SceneError
            There is no interface for the pair.
        """
        fallback = None
        for interface in self.interfaces.values():
            if interface.between == "any":
                fallback = interface
            elif set(interface.between) == {first, second}:
                return interface
        if fallback is not None:
            return fallback
        value = f'no interface between "{first}" and "{second}"'
        remedy = f'add [interfaces.NAME] with between = ["{first}", "{second}"]'
        place = self.source.place("interfaces")
        raise SceneError(Fault(place, value, "one for every pair that touches", remedy))

    @field_validator("effects", mode="before")
    @classmethod
    def _of_ones_own(cls, value: Any) -> Any:
        """Refuse tables that are named like a built-in effect and name no class."""
        for name, table in value.items() if isinstance(value, Mapping) else ():
            known = cls.model_fields.get(name)
            if known is not None and isinstance(table, Mapping) and "type" not in table:
                remedy = f"write {known.description} for the built-in one, or add type"
                expected = 'type = "module:Class" of an effect of one\'s own'
                raise fault(f"[effects.{name}] without type", expected, remedy)
        return value

    @model_validator(mode="wrap")
    @classmethod
    def _consistent(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        """Collect contradictions and faults of single values in one error."""
        details = [detail(*finding) for finding in contradictions(data)]
        try:
            scene = handler(data)
        except ValidationError as error:
            single = [again(item) for item in error.errors(include_url=False)]
            raise ValidationError.from_exception_data(cls.__name__, single + details) from None
        if details:
            raise ValidationError.from_exception_data(cls.__name__, details)
        return scene
