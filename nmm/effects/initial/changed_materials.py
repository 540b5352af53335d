"""The effect: blocks whose material a stage changes keep their stress.

The difference between the present stress and that of the new law at the present strain is a stress
at material points. It acts like an initial stress, so that the new law determines only the stress
of further strain.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.laws_at_points import INITIAL, STRESS, SWELLING
from nmm.assembly.matter import Matter
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressPoints
from nmm.assembly.transfer.history import nearest_points
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.initial.kept_stress import KeptStress
from nmm.effects.initial.stress_at_start import StressAtStart
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from nmm.effects.change import Change


class ChangedMaterials(Effect):
    """Force ``- int B^T tau`` of the stress differences ``tau`` of changed blocks."""

    name = "changed materials"
    external = False
    stays = True

    def __init__(self, model: Model, kept: KeptStress) -> None:
        self._model, self.kept = model, kept
        self._force = -model.thickness * kept.points.force(kept.stress)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Return no stress, as no material has changed yet."""
        _refuse(setup)
        return cls(setup.model, KeptStress.none(setup.model))

    def follow(self, change: "Change") -> Effect:
        """Return the stress on the new model, with that of materials that change now."""
        if change.kept is not None:
            return ChangedMaterials(change.new, change.kept)
        region = change.old.manifold.element_region[self.kept.points.rule.owner]
        points = _points(change.new, np.isin(change.new.manifold.element_region, region))
        stress = self.kept.carried(change.old, change.new, points)
        kept = KeptStress(points, stress, _initial(change.setup, points))
        return ChangedMaterials(change.new, kept)

    def kept_by(self, old: Setup, new: Setup, before: State, after: State) -> KeptStress:
        """Return the stress differences after a change of materials, on the new model."""
        changed = np.flatnonzero(old.region_material != new.region_material)
        _unheated(old, new, changed, before)
        had = old.model.manifold.element_region[self.kept.points.rule.owner]
        region = new.model.manifold.element_region
        points = _points(new.model, np.isin(region, [*changed, *had]))
        tau = self.kept.carried(old.model, new.model, points)
        there = np.isin(region[points.rule.owner], changed)
        was = _former(old, new, points, before, after)
        now = _answer(old, new, points, after, was)
        beside, kept = _initial(new, points), tau + was
        tau[there] += (was - now)[there]
        alike = there & _alike(old, new)[region[points.rule.owner]]
        tau += _missing(new, points, after, alike, kept + beside, tau + beside)
        return KeptStress(points, tau, beside)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n,), which is constant in the axes of bodies."""
        return self._force

    def mean_stress(self, state: State) -> Floats:
        return self.kept.mean(self._model)

    def mean_stress_across(self, state: State) -> Floats:
        """See `Effect.mean_stress_across`; laws that are not linear know of it themselves."""
        found = np.einsum("ei,ei->e", self._model.across_share, self.mean_stress(state))
        return np.where(self._model.remembers, 0.0, found)

    def stress_across_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        share, added = self._model.across_share[elements], self.stress_at(elements, points, time)
        found = np.einsum("mi,mi->m", share, added)
        return np.where(self._model.remembers[elements], 0.0, found)

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """See `Effect.stress_at`: the stress of the nearest material point."""
        return self.kept.at(elements, points)

    def energy(self, state: State) -> float:
        """Energy (J) that it adds to those of the strain and of the initial stress."""
        tau, rule = self.kept.stress, self.kept.points.rule
        elastic = self._model.elasticity[rule.owner]
        strain = np.linalg.solve(elastic, (tau / 2 + self.kept.beside)[:, :, None])[:, :, 0]
        density = np.einsum("qi,qi->q", tau, strain)
        stored = self._model.thickness * float(rule.weights @ density)
        return stored - float(self._force @ state.deformation)


def remembered(setup: Setup, old: Setup, kept: KeptStress, after: State, declared: State) -> State:
    """Return the state with the kept stress in the history of its material points."""
    matter, model = setup.model.matter, setup.model
    if not isinstance(matter, Matter):
        return after
    region = model.manifold.element_region[matter.points.rule.owner]
    changed = old.region_material[region] != setup.region_material[region]
    fresh = changed & ~_alike(old, setup)[region]
    history = {
        name: np.where(fresh[:, None], declared.history[name], value)
        if name in declared.history
        else value
        for name, value in after.history.items()
    }
    own = _places_of(matter.points, kept.points)
    there = own >= 0
    total = (kept.stress + kept.beside)[own]
    strain = np.linalg.solve(matter.elastic, total[:, :, None])[:, :, 0]
    known = history.get(INITIAL, np.zeros_like(strain))
    history[INITIAL] = np.where(there[:, None], strain, known)
    return replace(after, history=history)


def _points(model: Model, chosen: Bools) -> StressPoints:
    return StressPoints.of(model.manifold, chosen)


def _initial(setup: Setup, points: StressPoints) -> Floats:
    if not setup.scene.initial_stresses:
        return np.zeros((len(points), 3))
    rule = points.rule
    return StressAtStart.declared(setup).at(setup.model, rule.owner, rule.points)[:, :3]


def _former(old: Setup, new: Setup, points: StressPoints, before: State, after: State) -> Floats:
    """Stress (Q, 3) of the old law, without added stresses, at points of the new model."""
    region = new.model.manifold.element_region[points.rule.owner]
    found = _by_region(old, region) @ points.strain(after.deformation)[:, :, None]
    found, matter = found[:, :, 0], old.model.matter
    if isinstance(matter, Matter):
        near = nearest_points(old.model, matter.points, new.model, points)
        found = np.where(near[:, None] < 0, found, before.history[STRESS][near])
    return np.asarray(found)


def _answer(old: Setup, new: Setup, points: StressPoints, after: State, was: Floats) -> Floats:
    """Stress (Q, 3) of the new law at the present strain; at the elastic one if it has history."""
    region = new.model.manifold.element_region[points.rule.owner]
    elastic = np.linalg.solve(_by_region(old, region), was[:, :, None])[:, :, 0]
    strain = np.where(_alike(old, new)[region, None], elastic, points.strain(after.deformation))
    return np.asarray((_by_region(new, region) @ strain[:, :, None])[:, :, 0])


def _missing(
    new: Setup, points: StressPoints, after: State, alike: Bools, kept: Floats, beside: Floats
) -> Floats:
    """Stress (Q, 3) that creeping laws lack to the ``kept`` one with what acts ``beside`` them.

    They remember stress itself, and more than elastic strain: it is what they answer that counts.
    """
    matter, lacking = new.model.matter, np.zeros((len(points), 3))
    if not isinstance(matter, Matter):
        return lacking
    place = _places_of(points, matter.points)
    here = np.flatnonzero(alike & (place >= 0))
    strain, among = np.zeros((len(matter.points), 3)), np.zeros(len(matter.points), dtype=bool)
    shift = np.linalg.solve(matter.elastic[place[here]], beside[here][:, :, None])[:, :, 0]
    strain[place[here]] = points.strain(after.deformation)[here] + shift
    among[place[here]] = True
    found = matter.at_once(strain, after.history, among)[place[here]]
    lacking[here] = np.where(np.isnan(found), 0.0, kept[here] - found)
    return lacking


def _by_region(setup: Setup, region: Ints) -> Floats:
    """Elasticity (Q, 3, 3) of the materials of regions (Q,)."""
    model = setup.model
    matrices = np.array([law.stiffness(model.plane) for law in model.laws])
    return np.asarray(matrices[setup.region_material[region]])


def _alike(old: Setup, new: Setup) -> Bools:
    """(N,) whether regions have a law of the same class before and after."""
    kinds = [type(law) for law in new.model.laws]
    pairs = zip(old.region_material, new.region_material, strict=True)
    return np.array([kinds[one] is kinds[two] for one, two in pairs])


def _places_of(points: StressPoints, among: StressPoints) -> Ints:
    """Return the number of points (Q,) ``among`` others of the same manifold; -1 where absent."""
    one, other = points.rule.owner, among.rule.owner
    found = np.full(len(points), -1)
    found[np.isin(one, other)] = np.flatnonzero(np.isin(other, one))
    return found


def _unheated(old: Setup, new: Setup, changed: Ints, state: State) -> None:
    """Refuse another class of law for regions with thermal strain."""
    matter = old.model.matter
    if SWELLING not in state.history or not isinstance(matter, Matter):
        return
    region = old.model.manifold.element_region[matter.points.rule.owner]
    swollen = region[state.history[SWELLING][:, 0] != 0]
    for one in changed[np.isin(changed, swollen) & ~_alike(old, new)[changed]]:
        raise FormulationError(
            f"[[stages]] materials: block {old.region_name[one]}: heated matter that yields or "
            "creeps: expected a material of the same law, which knows what of its strain heat "
            "made: give it that law, or change the material before it is heated"
        )


def _refuse(setup: Setup) -> None:
    """Refuse finite strain and projected volumes, whose stress is not that of material points."""
    if setup.kinematics.finite or setup.model.projected:
        key = '[rotation] update = "finite"' if setup.kinematics.finite else "[cover] volumetric"
        raise FormulationError(
            f"[[stages]] materials with {key}: expected small strains, and volumes that are "
            'resisted in full: use update = "exact" and volumetric = "full"'
        )
