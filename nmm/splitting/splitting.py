"""Blocks split where their stress reaches their strength (Lin 1995).

In time a piece is judged only once a wave has crossed it since it came to be: until then it has the
stress that it was born with, which its new faces have not relieved yet. Without this the number of
pieces would be one of the time step. Water in the pores opens planes by the whole of its pressure
and takes it from what presses on them (Terzaghi; Jaeger, Cook and Zimmerman 2007, section 4.7).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.state import State
from nmm.assembly.stress_points import PressureAt
from nmm.effects.base import Effect, Setup
from nmm.effects.event import Event
from nmm.materials.tensors import ISOTROPIC
from nmm.splitting.cuts import Shapes
from nmm.splitting.division import SplitRules, allowed, first_cuts, replaced
from nmm.splitting.outlines import outlines
from nmm.splitting.refusals import refuse
from nmm.splitting.sites import Sites, Where
from nmm.splitting.strength import STRENGTHS, BlockStrength, SplitJudgement

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.view import View
    from nmm.scene.tables.splitting import SplittingTable

CONSTANTS = ("tensile_strength", "cohesion", "friction_angle")


@dataclass(frozen=True)
class SplitLaw:
    """Strength of a material, how far its blocks may split, and where they are judged.

    ``effective`` says whether by the stress of the grains or that of grains and water together.
    """

    strength: BlockStrength
    rules: SplitRules
    where: Where
    effective: bool


@dataclass(frozen=True)
class KeptWhole:
    """Number of blocks kept whole beyond their strength, and the largest share that one uses."""

    blocks: int = 0
    use: float = 0.0

    def beside(self, blocks: int, use: float) -> "KeptWhole":
        """Return these and some more."""
        return KeptWhole(self.blocks + blocks, max(self.use, float(use)))


class Splitting(Effect):
    """The blocks of all materials that may split.

    Attributes
    ----------
    kept
        Blocks that the rules keep whole, in the state that was judged last; they are told and
        decide nothing.
    born
        (B,) when each body came to be, s; minus infinity where it always was.
    """

    name = "splitting"
    external = False

    def __init__(self, setup: Setup, laws: Mapping[int, SplitLaw]) -> None:
        self._setup, self._laws, self.kept = setup, laws, KeptWhole()
        self._pores: Sequence[PressureAt] = ()
        manifold = setup.model.manifold
        self.born = np.full(manifold.n_bodies, -np.inf)
        material = np.zeros(manifold.n_bodies, dtype=np.int64)
        material[manifold.element_body] = setup.region_material[manifold.element_region]
        self._sites = {
            number: Sites.of(setup.model, law.where, material == number)
            for number, law in laws.items()
        }

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[splitting.MATERIAL]``.

        Raises
        ------
        SceneError, FormulationError
            See `refuse`.
        """
        refuse(setup)
        names, laws = list(setup.scene.materials), {}
        for name, table in setup.scene.splitting.items():  # a handful of materials
            rules = SplitRules(table.smallest_block, table.most_blocks)
            where, effective = table.judged_at, table.stress == "effective"
            laws[names.index(name)] = SplitLaw(strength_of(table), rules, where, effective)
        return cls(setup, laws)

    def follow(self, change: "Change") -> "Splitting":
        """Return the splitting of the present blocks."""
        new = Splitting(change.setup, self._laws)
        new.kept = self.kept
        bodies = change.parentage.bodies
        parted = np.bincount(bodies.parent, minlength=bodies.n_parents) > 1
        parent = np.maximum(bodies.main, 0)
        fresh = parted[parent] | (bodies.main < 0)
        new.born = np.where(fresh, change.state.time, self.born[parent])
        return new

    def receive_pore_pressures(self, pressures: Sequence[PressureAt]) -> None:
        """See `Effect.receive_pore_pressures`."""
        self._pores = pressures

    def event(self, view: "View") -> Event | None:
        """Return the event of all splits in a state, or None."""
        total, state = view.stress, view.state
        effective = total + ISOTROPIC * self._pore_pressure(state.time)[:, None]
        rests = self._rests(state.time)
        polygons, home = None, np.zeros(0, dtype=np.int64)
        splits: dict[int, Shapes] = {}
        pulled, kept = 0, KeptWhole()
        for number, law in self._laws.items():  # a handful of materials
            sites = self._sites[number]
            stress = effective if law.effective else total
            judged = law.strength.judged(np.asarray(sites.weights @ stress))
            order = sites.in_order(judged.use)
            over = order[(judged.use[order] >= 1) & rests[sites.body[order]]]
            if not len(over):
                continue
            if polygons is None:
                polygons, home = outlines(self._setup.model, self._setup.geometry.regions)
            shapes = polygons.to_shapely()
            cut, parts = self._divided(shapes, sites, over, judged, state, law.rules)
            pulled += int(judged.tension[cut].sum())
            splits |= zip(sites.body[cut].tolist(), parts, strict=True)
            whole = over[~np.isin(sites.body[over], sites.body[cut])]
            kept = kept.beside(len(np.unique(sites.body[whole])), judged.use[whole].max(initial=0))
        self.kept = kept
        if polygons is None or not splits:
            return None
        pieces, parent = replaced(polygons, splits)
        regions = self._setup.geometry.regions.divided(pieces, home[parent])
        geometry = replace(self._setup.geometry, regions=regions, in_pieces=True)
        return Event(geometry, _said(splits, pulled))

    def history(self, state: State) -> Mapping[str, float]:
        """Number of bodies, of those kept whole beyond their strength, and the most they use."""
        bodies = self._setup.model.manifold.n_bodies
        return {"bodies": bodies, "kept_whole": self.kept.blocks, "kept_use": self.kept.use}

    def carried(self) -> tuple[int, float, Floats]:
        return self.kept.blocks, self.kept.use, self.born

    def carry(self, carried: tuple[int, float, Floats]) -> None:
        blocks, use, self.born = carried
        self.kept = KeptWhole(blocks, use)

    def _pore_pressure(self, time: float) -> Floats:
        """(E,) pressure of the water at the middles of elements (Pa)."""
        elements = self._setup.model.manifold.elements
        total, every = np.zeros(len(elements)), np.arange(len(elements))
        for pressure in self._pores:  # of effects
            total += pressure(every, elements.centroids, time)
        return total

    def _rests(self, time: float) -> Bools:
        """Which bodies (B,) a wave has crossed since they came to be; all in statics."""
        if self._setup.scene.inertia is None:
            return np.ones(len(self.born), dtype=bool)
        return np.asarray(time - self.born >= self._crossing)

    @cached_property
    def _crossing(self) -> Floats:
        """(B,) time in which a wave crosses the root of each body's area (s)."""
        model, body = self._setup.model, self._setup.model.manifold.element_body
        slowness = np.zeros(model.manifold.n_bodies)
        slowness[body] = np.sqrt(model.density / model.modulus)
        return np.asarray(slowness * np.sqrt(model.manifold.body_area))

    def _divided(
        self,
        shapes: Shapes,
        sites: Sites,
        over: Ints,
        judged: SplitJudgement,
        state: State,
        rules: SplitRules,
    ) -> tuple[Ints, list[Shapes]]:
        """Return the sites at which bodies split, of shapes (B,), and the pieces of each.

        ``over`` (k,) are the sites beyond their strength in the order in which they are asked.
        """
        body, frames = sites.body[over], state.frames
        turned = frames.angle if frames.tilt is None else frames.angle + frames.tilt
        planes = judged.planes[over] - turned[body, None]
        at, parts = first_cuts(shapes, body, sites.point[over], planes, rules)
        more = np.array([len(one) - 1 for one in parts], dtype=np.int64)
        room = rules.most - len(np.unique(sites.body))
        may = np.flatnonzero(allowed(judged.use[over[at]], more, room))
        return over[at[may]], [parts[one] for one in may]


def strength_of(table: "SplittingTable") -> BlockStrength:
    """Return the strength that a table names."""
    given = {name: getattr(table, name) for name in CONSTANTS if getattr(table, name) is not None}
    law: BlockStrength = STRENGTHS.make(table.law, table.options, **given)
    return law


def _said(splits: Mapping[int, Shapes], pulled: int) -> str:
    """Describe how many blocks split, how, and into how many pieces."""
    n, pieces = len(splits), sum(len(shapes) for shapes in splits.values())
    by = {"tension": pulled, "shear": n - pulled}
    how = ", ".join(f"{count} by {mode}" for mode, count in by.items() if count)
    return f"{n} block{'s split' if n > 1 else ' splits'} into {pieces} ({how})"
