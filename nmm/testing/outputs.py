"""What every output is held to."""

from collections.abc import Mapping
from dataclasses import fields as fields_of
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.outputs.base import Output, View
from nmm.quantity import Quantity
from nmm.results.frame import Frame
from nmm.testing.claims import claim, finite
from nmm.testing.effects.promises import check_quantity

if TYPE_CHECKING:
    from nmm.scene import Scene

FRAME = {one.name for one in fields_of(Frame)}
TWO_BLOCKS = """
title = "two blocks"
plane = "stress"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2e3
[interfaces.joint]
friction_angle = 0.5
[[blocks]]
name = "floor"
material = "rock"
vertices = [[0, 0], [3, 0], [3, 1], [0, 1]]
[[blocks]]
name = "top"
material = "rock"
vertices = [[1, 1], [2, 1], [2, 2], [1, 2]]
[[supports]]
name = "hold"
block = "floor"
fix = ["x", "y"]
[gravity]
[contact]
"""


def check_output(output: Output, scene: "Scene | None" = None) -> None:
    """Hold an output to what every one promises, at every frame of a run.

    It declares quantities or numbers for the history; they fit what they belong to, are finite or
    nan, have names of their own, and are the same when asked for again; the state and its stress
    are not changed.

    Parameters
    ----------
    output
        The output.
    scene
        What is run; a block that comes to rest on another when not given.

    Raises
    ------
    AssertionError
        Naming the property that is not kept.
    """
    for view in _views(scene):
        _check(output, type(output).__name__, view)


def _check(output: Output, name: str, view: View) -> None:
    count = 0 if view.contacts is None else len(view.contacts)
    deformation, stress = view.state.deformation.copy(), view.stress.copy()
    fields, row = output.fields(view), output.history(view)
    claim(bool(fields or row), f"{name}: it declares neither fields nor history")
    again = output.fields(view)
    for key, one in fields.items():
        claim(bool(key), f"{name}: a quantity without a name")
        claim(key not in FRAME, f"{name}: quantity {key}: the name is that of a frame's own")
        check_quantity(f"{name}: quantity {key}", one, view.model, count)
        same = np.array_equal(one.values, again[key].values, equal_nan=True)
        claim(same, f"{name}: quantity {key} differs when it is asked for again")
    for key, value in row.items():
        finite(f"{name}: history {key}", value)
    claim(np.array_equal(deformation, view.state.deformation), f"{name}: it changed the state")
    claim(np.array_equal(stress, view.stress), f"{name}: it changed the stress it was given")


class Keeper(Output):
    """Keeps the views that a run shows to outputs."""

    views: ClassVar[list[View]] = []

    def fields(self, view: View) -> Mapping[str, Quantity]:
        Keeper.views.append(view)
        return {}


def _views(scene: "Scene | None") -> list[View]:
    """Run a scene and return what outputs see of its frames."""
    import nmm
    from nmm.scene.output import OutputTable

    shown = scene or nmm.parse_scene(TWO_BLOCKS)
    Keeper.views.clear()
    keeper = OutputTable(quantities=("nmm.testing.outputs:Keeper",))
    nmm.run(shown.model_copy(update={"output": keeper}))
    return [*Keeper.views]
