"""Measures of the stress: von Mises of all of it, others of what acts in the plane."""

from collections.abc import Mapping

import numpy as np

from integration.arrays import Floats
from nmm.materials.principal_stresses import PrincipalStresses
from nmm.outputs.base import Output, View
from nmm.quantity import Quantity


class VonMises(Output):
    """Von Mises stress of each element (Pa), the stress across the plane with it."""

    def fields(self, view: View) -> Mapping[str, Quantity]:
        values = von_mises(view.stress, view.stress_across)
        return {"von_mises": Quantity("elements", values, "Pa")}


class PrincipalStress(Output):
    """Major and minor principal stress of each element in the plane (Pa), tension positive."""

    def fields(self, view: View) -> Mapping[str, Quantity]:
        values = principal(view.stress)
        return {"principal_stress": Quantity("elements", values, "Pa", ("major", "minor"))}


class MeanStress(Output):
    """Mean of the two normal stresses of each element in the plane (Pa), tension positive."""

    def fields(self, view: View) -> Mapping[str, Quantity]:
        return {"mean_stress": Quantity("elements", view.stress[:, :2].mean(axis=1), "Pa")}


def von_mises(stress: Floats, across: Floats | None = None) -> Floats:
    """Return the von Mises stress (E,) of stresses (E, 3) and what acts ``across`` the plane (E,).

    ``sqrt(((xx - yy)^2 + (yy - zz)^2 + (zz - xx)^2) / 2 + 3 xy^2)``; None across is plane stress.
    """
    xx, yy, xy = stress.T
    zz = np.zeros_like(xx) if across is None else across
    differences = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(differences / 2 + 3 * xy**2))


def principal(stress: Floats) -> Floats:
    """Return the major and minor principal stress (E, 2) of stresses (E, 3)."""
    found = PrincipalStresses.of(stress)
    return np.stack([found.larger, found.smaller], axis=1)
