"""What cracks cannot grow by, told before anything runs."""

from integration.arrays import Ints
from nmm.effects.base import Setup
from nmm.errors import Fault, FormulationError, SceneError


def refuse(setup: Setup, tips: Ints) -> None:
    """Refuse scenes without anything to grow, and what cannot carry the growth.

    Parameters
    ----------
    tips
        (n,) number of the tip of each front; -1 where it has none.

    Raises
    ------
    SceneError
        No crack that ends inside a block.
    FormulationError
        A cover whose tips carry no functions, answers that no factor scales, or matter that is not
        linear.
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
    if table is not None and table.control == "toughness" and update not in ("auto", "small"):
        place = setup.formulation.source.place("rotation", "update")
        value, expected = f'"{update}" with control = "toughness"', "answers that a factor scales"
        remedy = 'leave it out, or use control = "loads" in [fracture]'
        raise FormulationError(Fault(place, value, expected, remedy))
    if model.matter is not None:
        remedy = "use elastic materials and small strain, or remove [fracture]"
        raise FormulationError(Fault(place, model.bent, "elastic matter", remedy))
