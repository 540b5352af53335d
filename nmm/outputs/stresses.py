"""Measures of the stress in the plane; what acts across the plane is left out."""

from collections.abc import Mapping

import numpy as np

from integration.arrays import Floats
from nmm.materials.principal_stresses import PrincipalStresses
from nmm.outputs.base import Output, View
from nmm.quantity import Quantity


class VonMises(Output):
    """Von Mises stress of each element (Pa), exact in plane stress."""

    def fields(self, view: View) -> Mapping[str, Quantity]:
        return {"von_mises": Quantity("elements", von_mises(view.stress), "Pa")}


class PrincipalStress(Output):
    """Major and minor principal stress of each element in the plane (Pa), tension positive."""

    def fields(self, view: View) -> Mapping[str, Quantity]:
        values = principal(view.stress)
        return {"principal_stress": Quantity("elements", values, "Pa", ("major", "minor"))}


class MeanStress(Output):
    """Mean of the two normal stresses of each element in the plane (Pa), tension positive."""

    def fields(self, view: View) -> Mapping[str, Quantity]:
        return {"mean_stress": Quantity("elements", view.stress[:, :2].mean(axis=1), "Pa")}


def von_mises(stress: Floats) -> Floats:
    """Return ``sqrt(xx^2 - xx yy + yy^2 + 3 xy^2)`` (E,) of stresses (E, 3)."""
    xx, yy, xy = stress.T
    return np.asarray(np.sqrt(np.maximum(xx**2 - xx * yy + yy**2 + 3 * xy**2, 0.0)))


def principal(stress: Floats) -> Floats:
    """Return the major and minor principal stress (E, 2) of stresses (E, 3)."""
    found = PrincipalStresses.of(stress)
    return np.stack([found.larger, found.smaller], axis=1)
