"""Cracks that begin: the rule of a scene on a model, and the geometry with one more crack."""

from dataclasses import replace

import numpy as np

from nmm.effects.base import Setup
from nmm.fracture.growth.intensities import tip_moduli
from nmm.fracture.nucleation.nuclei import Nuclei, Nucleus
from nmm.fracture.nucleation.rule import NucleationRule
from nmm.fracture.toughness import Toughness
from nmm.geometry.geometry import Geometry


def nucleation_rule(setup: Setup, toughness: Toughness) -> NucleationRule | None:
    """Return the rule of ``[fracture.nucleation]`` for the materials of a model."""
    table = setup.scene.fracture
    if table is None or table.nucleation is None:
        return None
    _, stiff = tip_moduli(setup.model, np.arange(len(setup.model.manifold.elements)))
    return NucleationRule.of(table.nucleation, toughness, stiff)


def nuclei_of(setup: Setup, rule: NucleationRule | None) -> Nuclei | None:
    """Return where cracks may still begin in a geometry; None where no more may."""
    if rule is None or len(setup.geometry.nuclei) >= rule.most:
        return None
    return Nuclei.of(setup.model, setup.geometry, rule)


def with_nucleus(geometry: Geometry, nuclei: Nuclei, one: Nucleus) -> Geometry:
    """Return the geometry with the crack that begins at a place."""
    cracks = (*geometry.cracks, nuclei.laid(one))
    return replace(geometry, cracks=cracks, nuclei=(*geometry.nuclei, len(geometry.cracks)))
