"""Checks of crack growth and nucleation, before the run starts."""

from typing import TYPE_CHECKING

from integration.arrays import Ints
from nmm.effects.base import Setup
from nmm.errors import Fault, FormulationError, SceneError
from nmm.geometry.tessellation.cover_types import functions_of, named_functions

if TYPE_CHECKING:
    from nmm.fracture.nucleation.nuclei import Nuclei
    from nmm.fracture.nucleation.rule import NucleationRule


def refuse(setup: Setup, tips: Ints) -> None:
    """Refuse scenes in which no crack can grow, and formulations that cannot carry the growth.

    Parameters
    ----------
    tips
        (n,) number of the tip of each front; -1 where there is none.

    Raises
    ------
    SceneError
        No crack ends inside a block, or the domain about tips is smaller than a cell.
    FormulationError
        Tips without tip functions, control by toughness with finite rotations, or nonlinear
        material.
    """
    scene, model = setup.scene, setup.model
    place = scene.source.place("fracture")
    begins = scene.fracture is not None and scene.fracture.nucleation is not None
    if not (tips >= 0).any() and not begins:
        remedy = "let one of [[cracks]] end inside a block, or add [fracture.nucleation]"
        raise SceneError(Fault(place, "no crack tip", "a crack that can grow", remedy))
    singular = model.manifold.singular
    for point in model.cut.tips.point[tips[tips >= 0]]:  # a handful of tips
        if not (singular == point).all(axis=1).any():
            value = f"the tip at {point.tolist()} carries no tip functions"
            expected = "a mesh of monomials, with cells of less than a third of the crack's length"
            remedy = "correct functions or size of [cover], or tips of [cover.enrichment]"
            raise FormulationError(Fault(place, value, expected, remedy))
    table, update = scene.fracture, setup.formulation.rotation.update
    size = setup.formulation.cover.finest
    if table is not None and table.radius is not None and size and table.radius < size:
        value, expected = f"{table.radius:g} m", f"at least a cell of the cover, {size:g} m"
        remedy = "leave it out: four cells are taken, less where the crack is shorter"
        raise SceneError(Fault(scene.source.place("fracture", "radius"), value, expected, remedy))
    if table is not None and table.control == "toughness" and update not in ("auto", "small"):
        place = setup.formulation.source.place("rotation", "update")
        value, expected = f'"{update}" with control = "toughness"', "answers that a factor scales"
        remedy = 'leave it out, or use control = "loads" in [fracture]'
        raise FormulationError(Fault(place, value, expected, remedy))
    if model.matter is not None:
        remedy = "use elastic materials and small strain, or remove [fracture]"
        raise FormulationError(Fault(place, model.bent, "elastic matter", remedy))
    for name, law in zip(scene.materials, model.laws, strict=True):  # a handful of materials
        if law.kolosov(model.plane) is None:
            place = scene.source.place("materials", name, "law")
            value, expected = f'"{scene.materials[name].law}" with [fracture]', "isotropic matter"
            remedy = 'use law = "elastic", or remove [fracture]: intensities would be wrong'
            raise SceneError(Fault(place, value, expected, remedy))


def refuse_nucleation(setup: Setup, nuclei: "Nuclei") -> None:
    """Refuse covers on which no crack can nucleate, and lines of the mean that fit into no body.

    Raises
    ------
    FormulationError
        A cover without tip functions.
    SceneError
        The length of the mean is too large.
    """
    cover, place = setup.formulation.cover, setup.scene.source.place("fracture", "nucleation")
    plain = cover.enrichment is not None and not cover.enrichment.tips
    if cover.size is None or plain or not functions_of(cover).enriched:
        value = "tips = false" if plain else f'cover "{cover.type}" of "{named_functions(cover)}"'
        remedy = 'use type = "triangles" with a size in [cover], and leave tips to it'
        raise FormulationError(Fault(place, value, "a mesh whose tips carry functions", remedy))
    if not nuclei.fits:
        place = setup.scene.source.place("fracture", "nucleation", "length")
        value = f"{nuclei.rule.length:g} m"
        remedy = "give a smaller length, or check toughness and strength, from which it follows"
        expected = "a length that goes across an edge into a block and ends before the other side"
        raise SceneError(Fault(place, value, expected, remedy))


def short_nuclei(setup: Setup, rule: "NucleationRule") -> str:
    """Return a warning about nuclei that are too short, in words; empty where there is none."""
    size, length = setup.formulation.cover.finest, rule.crack_length or rule.critical_length
    said = []
    if size is not None and min(length, rule.length) < size * (1 - 1e-9):
        said.append(
            f"cracks of {length:g} m begin by means over {rule.length:g} m on cells of {size:g} m: "
            "with half a cell means beside a hole are 5 to 9 % too low, intensities up to 5 % off, "
            "and tips may carry no functions; from a cell on 1 to 2 % and 0.6 %"
        )
    if length < rule.critical_length * (1 - 1e-9):
        said.append(
            f"cracks begin {length:g} m long: under even stress they free less than their faces "
            f"take by the toughness, from {rule.critical_length:.3g} m on as much"
        )
    return "; ".join(said)
