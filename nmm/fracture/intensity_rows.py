"""Stress intensity factors at a tip as linear functionals of the displacement."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.applied_forces import AppliedForces, Density
from nmm.assembly.model import Model
from nmm.assembly.state import Frames
from nmm.assembly.stress_points import StressAt
from nmm.fracture.auxiliary import Auxiliary
from nmm.fracture.interaction import Field, Interaction, Traction
from nmm.fracture.interaction_weights import ForceWeights, InteractionWeights

# Step of the finite differences of stress, as a share of the radius of the domain.
NEARBY = 1e-4


@dataclass(frozen=True)
class IntensityRows:
    """The linear functionals that give K_I and K_II of one tip; computed once for a model.

    Attributes
    ----------
    model
        The model.
    element
        The element ahead of the tip.
    stiff
        Effective modulus E' of the material about the tip (Pa): E in plane stress, E / (1 - nu^2)
        in plane strain.
    unknowns
        (2, n) factors of the unknowns.
    pressures
        (2, k) factors of the projected pressures; None where volumes are not projected.
    fixed
        (2,) contribution of the loads that do not change.
    force_weights
        Quadrature points of the domain with the factors of body forces.
    stress_weights
        Quadrature points of the domain with the factors of displacement gradients and stresses.
    interaction
        The interaction integral that they come from.
    """

    model: Model
    element: int
    stiff: float
    unknowns: Floats
    pressures: Floats | None
    fixed: Floats
    force_weights: tuple[ForceWeights, ...]
    stress_weights: tuple[InteractionWeights, ...]
    interaction: Interaction

    @classmethod
    def of(
        cls,
        model: Model,
        tip: int,
        radius: float,
        kappa: float,
        face_traction: Traction | None = None,
    ) -> "IntensityRows":
        """Return the functionals of a tip, by its number in ``model.cut.tips``."""
        tips = model.cut.tips
        element = tips.element[tip]
        shear = float(model.elasticity[element, 2, 2])
        fields = Auxiliary.of(tips.point[tip], tips.direction[tip], kappa, shear)
        body = int(model.manifold.element_body[element])
        interaction = Interaction(model, fields, radius, body)
        volume = list(interaction.over_elements())
        faces = list(interaction.over_faces(face_traction))
        weights = [
            part
            for part in (*(one for one, _ in volume), *faces)
            if isinstance(part, InteractionWeights) and len(part.points)
        ]
        fixed = sum((p for p in faces if not isinstance(p, InteractionWeights)), start=np.zeros(2))
        stiff = 8 * shear / (kappa + 1)
        total = np.sum([_on_unknowns(model, part) for part in weights], axis=0)
        held = model.pressures if model.projected else None
        pressed = None
        if held is not None:
            parts = [held.rows(model.manifold, w.owner, w.points).T @ w.pressure for w in weights]
            pressed = np.asarray(stiff / 2 * np.sum(parts, axis=0).T)
        return cls(
            model,
            int(element),
            stiff,
            stiff / 2 * total,
            pressed,
            stiff / 2 * fixed,
            tuple(forces for _, forces in volume),
            tuple(weights),
            interaction,
        )

    @property
    def body(self) -> int:
        """The body that the tip lies in."""
        return int(self.model.manifold.element_body[self.element])

    @property
    def density(self) -> float:
        """Density of the material about the tip (kg/m3)."""
        return float(self.model.density[self.element])

    def intensities(self, unknowns: Floats, pressure: Floats | None) -> Floats:
        """K_I and K_II (2,) of unknowns (n,) and projected pressures (k,) (Pa m^1/2)."""
        found = np.asarray(self.unknowns @ unknowns + self.fixed)
        if self.pressures is None or pressure is None:
            return found
        return np.asarray(found + self.pressures @ pressure)

    def of_weight(self, density: Floats) -> Floats:
        """Contribution (2,) of a uniform body force (2,) (N/m3)."""
        return self._even @ density

    def of_forces(self, density: Field) -> Floats:
        """Contribution (2,) of a body force that is a function of points (N/m3)."""
        return self._of_densities(lambda part: density(part.points))

    def _of_densities(self, density: Callable[[ForceWeights], Floats]) -> Floats:
        parts = [np.einsum("mni,mi->n", p.force, density(p)) for p in self.force_weights]
        return np.asarray(self.stiff / 2 * np.sum(parts, axis=0))

    def of_applied_forces(self, pushes: AppliedForces, frames: Frames) -> Floats:
        """Contribution (2,) of forces at points, on crack faces and volume, inertia and damping."""
        found = self._of_point_forces(pushes, frames) if len(pushes) else np.zeros(2)
        for density in pushes.densities:  # one an effect or a field
            found = found + self._of_densities(partial(self._within, density, frames))
        for acceleration in pushes.accelerations:
            found = found + self.of_acceleration(acceleration)
        for strain in pushes.strains:
            found = found + self.intensities(strain, self.model.pressure(strain)) - self.fixed
        return found

    def _of_point_forces(self, pushes: AppliedForces, frames: Frames) -> Floats:
        body = np.full(len(pushes), self.body)
        turned = replace(pushes, force=frames.to_body(body, pushes.force))
        found = self.interaction.of_point_forces(turned)
        return np.asarray(self.stiff / 2 * found / self.model.thickness)

    def _within(self, density: Density, frames: Frames, part: ForceWeights) -> Floats:
        """Body force (m, 2) at the points of a part of the domain, in the axes of the body."""
        body = np.full(len(part.owner), self.body)
        return frames.to_body(body, density(part.owner, part.points))

    def of_stress(self, stress: StressAt, time: float) -> Floats:
        """Contribution (2,) of a stress that does not follow from the strain.

        The term of its gradient needs the derivative along the direction ahead (Shih, Moran and
        Nakamura 1986).
        """
        total, step = np.zeros(2), NEARBY * self.interaction.radius
        way = step * self.interaction.fields.tip.direction
        for part in self.stress_weights:
            total += _contracted(part.stress, stress(part.owner, part.points, time))
        for one in self.force_weights:
            before, after = (stress(one.owner, one.points + way * s, time) for s in (-1, 1))
            total += _contracted(one.slope, (after - before) / (2 * step))
        return np.asarray(self.stiff / 2 * total)

    def of_acceleration(self, acceleration: Floats) -> Floats:
        """Contribution (2,) of the inertia of an acceleration of the unknowns (n,)."""
        return self._inert @ acceleration

    @cached_property
    def _even(self) -> Floats:
        """(2 modes, 2) factors of a uniform body force."""
        total = np.sum([p.force.sum(axis=0) for p in self.force_weights], axis=0)
        return np.asarray(self.stiff / 2 * total)

    @cached_property
    def _inert(self) -> Floats:
        """(2, n) factors of accelerations."""
        model, total = self.model, np.zeros_like(self.unknowns)
        for part in self.force_weights:  # close to the tip and further out
            rows = model.manifold.rows(part.owner, part.points)
            force = -model.density[part.owner, None, None] * part.force
            values = np.moveaxis(force @ rows.values, 1, 0)
            total += _summed(rows.unknowns, values, model)
        return self.stiff / 2 * total


def _on_unknowns(model: Model, part: InteractionWeights) -> Floats:
    """Factors (2, n) of the unknowns, from those of the displacement gradient at points."""
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
