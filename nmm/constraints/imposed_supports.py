"""What holds the supports of a scene: the chosen method along edges, springs elsewhere."""

from collections.abc import Sequence
from dataclasses import replace

from nmm.constraints.imposition import Imposition, Method
from nmm.constraints.interface import Interface
from nmm.constraints.laid_springs import facing_joints, laid_under_stress, on_joints
from nmm.constraints.points_under_stress import laid_at_points
from nmm.effects.base import Setup


def imposed(
    setup: Setup, interfaces: Sequence[Interface], method: Method
) -> tuple[list[Imposition], str]:
    """Return what holds each interface, and a caution where tractions are shared with joints.

    Springs need no traction: they hold points that are no edge, and where the method is free to
    be chosen faces of joints, whose traction the support and the neighbour share.
    """
    edges = [i for i, one in enumerate(interfaces) if one.first.normal is not None]
    shared = _on_joints(setup, method, [interfaces[i] for i in edges])
    free = setup.formulation.supports.method == "auto"
    if free:
        edges = [i for i in edges if interfaces[i].name not in shared]
    found = replace(method, kind="penalty").impose(setup.model, interfaces)
    along = method.impose(setup.model, [interfaces[i] for i in edges])
    for i, support in zip(edges, along, strict=True):
        found[i] = support
    if setup.scene.initial_stresses:
        found = laid_at_points(setup, laid_under_stress(setup, found))
    return found, _shared_tractions(shared) if shared and not free else ""


def _on_joints(setup: Setup, method: Method, edges: Sequence[Interface]) -> list[str]:
    """Return the names of those supports by Nitsche's method that hold faces of joints."""
    if method.kind != "nitsche" or setup.model.manifold.n_bodies == 1:
        return []
    joints = facing_joints(setup)
    return [one.name for one in edges if on_joints(joints, one.first).any()]


def _shared_tractions(names: Sequence[str]) -> str:
    """Tell that Nitsche's method holds faces of joints, in words."""
    named = ", ".join(f'"{name}"' for name in names)
    return (
        f"{named} on faces of joints by Nitsche's method, which takes the traction of the body for "
        "the support's: the neighbour has a part of it, and held faces move by that over the "
        'penalty; leave out [supports] method, or use "lagrange"'
    )
