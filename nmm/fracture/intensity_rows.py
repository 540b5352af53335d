"""Stress intensities at a tip as linear functions of the displacement: found once for a model."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import Frames
from nmm.assembly.pushes import Density, Pushes
from nmm.assembly.stress_points import StressAt
from nmm.fracture.auxiliary import Auxiliary
from nmm.fracture.interaction import Field, Interaction, InteractionWeights, Pulled, Traction

# Part of the radius of a domain over which slopes of stress are taken, within one element's field.
NEARBY = 1e-4


@dataclass(frozen=True)
class IntensityRows:
    """K_I and K_II of a tip, as sums over what the model knows.

    Attributes
    ----------
    model
        The model.
    element
        Ahead of the tip.
    stiff
        E' of the material about the tip (Pa).
    unknowns
        (2, n) factors of the displacements.
    pressures
        (2, k) factors of the pressures on patches; None without.
    fixed
        (2,) of loads that do not change.
    pulled
        Places of the domain, with the factors of forces on the volume.
    weighed
        The same with the factors of gradients and stresses.
    about
        The domain.
    """

    model: Model
    element: int
    stiff: float
    unknowns: Floats
    pressures: Floats | None
    fixed: Floats
    pulled: tuple[Pulled, ...]
    weighed: tuple[InteractionWeights, ...]
    about: Interaction

    @classmethod
    def of(
        cls,
        model: Model,
        tip: int,
        radius: float,
        kappa: float,
        face_traction: Traction | None = None,
    ) -> "IntensityRows":
        """Return the rows of a tip (number in ``model.cut.tips``), see `stress_intensity`."""
        tips = model.cut.tips
        element = tips.element[tip]
        shear = float(model.elasticity[element, 2, 2])
        fields = Auxiliary.of(tips.point[tip], tips.direction[tip], kappa, shear)
        body = int(model.manifold.element_body[element])
        about = Interaction(model, fields, radius, body)
        volume = list(about.over_elements())
        faces = list(about.over_faces(face_traction))
        weighed = [part for part, _ in volume] + [
            p for p in faces if isinstance(p, InteractionWeights)
        ]
        weighed = [part for part in weighed if len(part.points)]
        fixed = sum((p for p in faces if not isinstance(p, InteractionWeights)), start=np.zeros(2))
        stiff = 8 * shear / (kappa + 1)
        total = np.sum([_on_unknowns(model, part) for part in weighed], axis=0)
        held = model.pressures if model.projected else None
        pressed = None
        if held is not None:
            parts = [held.rows(model.manifold, w.owner, w.points).T @ w.pressure for w in weighed]
            pressed = np.asarray(stiff / 2 * np.sum(parts, axis=0).T)
        return cls(
            model,
            int(element),
            stiff,
            stiff / 2 * total,
            pressed,
            stiff / 2 * fixed,
            tuple(pulled for _, pulled in volume),
            tuple(weighed),
            about,
        )

    @property
    def body(self) -> int:
        """The body that it lies in."""
        return int(self.model.manifold.element_body[self.element])

    @property
    def density(self) -> float:
        """Of the material about it (kg/m3)."""
        return float(self.model.density[self.element])

    def intensities(self, unknowns: Floats, pressure: Floats | None) -> Floats:
        """K_I and K_II (2,) of displacements (n,) and pressures on patches (k,) (Pa m^1/2)."""
        found = np.asarray(self.unknowns @ unknowns + self.fixed)
        if self.pressures is None or pressure is None:
            return found
        return np.asarray(found + self.pressures @ pressure)

    def of_weight(self, density: Floats) -> Floats:
        """Part (2,) of a force (2,) on every volume about the tip (N/m3)."""
        return self._even @ density

    def of_forces(self, density: Field) -> Floats:
        """Part (2,) of forces on the volume, a function of points (N/m3)."""
        return self._of_densities(lambda part: density(part.points))

    def _of_densities(self, density: Callable[[Pulled], Floats]) -> Floats:
        parts = [np.einsum("mni,mi->n", p.force, density(p)) for p in self.pulled]
        return np.asarray(self.stiff / 2 * np.sum(parts, axis=0))

    def of_pushes(self, pushes: Pushes, frames: Frames) -> Floats:
        """Part (2,) of forces at places and on the volume."""
        body = np.full(len(pushes), self.body)
        turned = replace(pushes, force=frames.to_body(body, pushes.force))
        found = self.stiff / 2 * self.about.pushed(turned) / self.model.thickness
        for density in pushes.densities:  # one an effect or a field
            found = found + self._of_densities(partial(self._within, density, frames))
        return found

    def _within(self, density: Density, frames: Frames, part: Pulled) -> Floats:
        """Density (m, 2) at the places of a part, in the axes of the body."""
        body = np.full(len(part.owner), self.body)
        return frames.to_body(body, density(part.owner, part.points))

    def of_stress(self, stress: StressAt, time: float) -> Floats:
        """Part (2,) of a stress that is no strain's: of eigenstrain, or of water in the pores.

        What a gradient of eigenstrain adds is taken along the direction ahead (Shih, Moran and
        Nakamura 1986).
        """
        total, step = np.zeros(2), NEARBY * self.about.radius
        way = step * self.about.fields.tip.direction
        for part in self.weighed:
            total += _contracted(part.stress, stress(part.owner, part.points, time))
        for one in self.pulled:
            before, after = (stress(one.owner, one.points + way * s, time) for s in (-1, 1))
            total += _contracted(one.slope, (after - before) / (2 * step))
        return np.asarray(self.stiff / 2 * total)

    def of_acceleration(self, acceleration: Floats) -> Floats:
        """Part (2,) of the inertia of the unknowns' acceleration (n,)."""
        return self._inert @ acceleration

    @cached_property
    def _even(self) -> Floats:
        """(2 modes, 2) factors of a uniform force."""
        total = np.sum([p.force.sum(axis=0) for p in self.pulled], axis=0)
        return np.asarray(self.stiff / 2 * total)

    @cached_property
    def _inert(self) -> Floats:
        """(2, n) factors of accelerations."""
        model, total = self.model, np.zeros_like(self.unknowns)
        for part in self.pulled:  # close to the tip and further out
            rows = model.manifold.rows(part.owner, part.points)
            force = -model.density[part.owner, None, None] * part.force
            values = np.moveaxis(force @ rows.values, 1, 0)
            total += _summed(rows.unknowns, values, model)
        return self.stiff / 2 * total


def _on_unknowns(model: Model, part: InteractionWeights) -> Floats:
    """Factors (2, n) of the unknowns, from those of the gradient at places."""
    index, rows = model.manifold.gradient_rows(part.owner, part.points)
    m, n = part.gradient.shape[:2]
    values = part.gradient.reshape(m, n, 4) @ rows.reshape(m, 4, -1)
    return _summed(index, np.moveaxis(values, 1, 0), model)


def _contracted(factors: Floats, stress: Floats) -> Floats:
    """Sum (2,) of factors (m, 2 modes, 2, 2) times stresses (m, 3)."""
    tensor = stress[:, [0, 2, 2, 1]].reshape(-1, 2, 2)
    return np.asarray(np.einsum("mnij,mij->n", factors, tensor))


def _summed(index: Ints, values: Floats, model: Model) -> Floats:
    n = model.manifold.n_unknowns
    return np.stack([np.bincount(index.ravel(), mode.ravel(), minlength=n) for mode in values])
