"""Kernels compiled before they are needed, by runs that are as small as they come."""

from typing import TYPE_CHECKING

from nmm.shipped import example

if TYPE_CHECKING:
    from nmm.scene import Scene

BEAM, WALL = "kitoh_beam/kitoh_130.toml", "stack/stack.toml"
BLOCKS = 30
"""Of the beam: more unknowns than are solved for with full matrices."""
DURATION = 0.005
"""Of the wall (s)."""


def compile_kernels() -> None:
    """Compile what blocks in contact need, in statics and in time; nothing is done twice."""
    import nmm

    for scene in (_small_beam(), _short_wall()):
        nmm.run(scene)


def _small_beam() -> "Scene":
    import nmm

    scene = nmm.read_scene(example(BEAM))
    fewer = [one.model_copy(update={"blocks": BLOCKS}) for one in scene.tessellations]
    return scene.model_copy(update={"tessellations": tuple(fewer)})


def _short_wall() -> "Scene":
    import nmm

    return nmm.read_scene(example(WALL)).model_copy(update={"duration": DURATION})
