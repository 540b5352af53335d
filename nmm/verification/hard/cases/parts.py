"""Every exchangeable part there is, read from the registries: a new one joins by itself."""

from collections.abc import Iterator, Mapping
from copy import deepcopy
from typing import Any

import numpy as np
from scipy.sparse import csc_array

from covers.mathematical.registry import COVERS
from nmm.constraints.imposition import IMPOSITIONS
from nmm.contact.enforcement.base import ENFORCEMENTS
from nmm.errors import NmmError
from nmm.integrators.base import INTEGRATORS
from nmm.solvers.linear import SOLVERS
from nmm.verification.hard.cases.base import Document, HardCase, Judge

BLOCKS: dict[str, Document] = {
    "block": {"type": "block"},
    "rigid": {"type": "block", "functions": "rigid"},
    "block degree 2": {"type": "block", "functions": "monomials", "degree": 2},
}
"""Covers of one patch a block."""


def enforcements() -> list[str]:
    """Names of the contact enforcements."""
    return list(ENFORCEMENTS.table)


def integrators() -> list[str]:
    """Names of the time integrators."""
    return list(INTEGRATORS.table)


def integrators_of_contact() -> list[str]:
    """Names of the time integrators that go with contact; the others refuse it before a run."""
    return [name for name in integrators() if _goes_with_contact(name)]


def with_integrator(name: str) -> dict[str, str]:
    """Parts of a formulation with an integrator, for `with_parts`: its kinematics among them."""
    finite = {"rotation.update": "finite"} if INTEGRATORS.make(name).conserves else {}
    return {"integrator.type": name, **finite}


def _goes_with_contact(name: str) -> bool:
    try:
        INTEGRATORS.make(name).among_contacts  # noqa: B018  # asked for its refusal
    except NmmError:
        return False
    return True


def solvers() -> list[str]:
    """Names of the linear solvers that are installed here: what misses says so when it solves."""
    return [name for name in SOLVERS.table if _solves(name)]


def _solves(name: str) -> bool:
    try:
        SOLVERS.make(name).decompose(csc_array(np.eye(2)))
    except NmmError:
        return False
    return True


def support_methods() -> list[str]:
    """Names of the ways to hold an edge; "auto" is one of the others."""
    return [name for name in IMPOSITIONS.table if name != "spring"]


def glue_methods() -> list[str]:
    """Names of the ways to glue blocks; "auto" is one of the others."""
    return [name for name in IMPOSITIONS.table if name != "penalty"]


def meshes(size: float, degrees: tuple[int, ...] = (0, 1, 2)) -> dict[str, Document]:
    """Tables of every cover of more patches than one, of cells of ``size`` (m), by their names."""
    return {
        f"{kind} degree {degree}": {
            "type": kind,
            "size": size,
            "functions": "monomials",
            "degree": degree,
        }
        for kind in COVERS
        for degree in degrees
    }


def with_parts(scene: Document, parts: Mapping[str, Any]) -> Document:
    """Return a scene whose formulation has other parts.

    Parameters
    ----------
    scene
        Tables; they are not changed.
    parts
        Values by the path of their key, such as ``{"contact.enforcement": "cone"}``.
    """
    made = deepcopy(scene)
    for path, value in parts.items():
        table = made.setdefault("formulation", {})
        *way, key = path.split(".")
        for name in way:
            table = table.setdefault(name, {})
        table[key] = deepcopy(value)
    return made


def moving_parts() -> Iterator[dict[str, str]]:
    """Yield every enforcement and every integrator: each of both with the first of the other.

    The whole product follows with the seeds of a class, which draw the rest.
    """
    forces, times = enforcements(), integrators_of_contact()
    for name in forces:
        yield {"enforcement": name, "integrator": times[0]}
    for name in times[1:]:
        for force in forces[:1] + forces[3:4]:
            yield {"enforcement": force, "integrator": name}


def over_parts(
    words: str,
    scene: Document,
    step: float,
    judge: Judge,
    slow: bool = False,
    kinds: Mapping[str, str] | None = None,
) -> Iterator[HardCase]:
    """Yield a scene of bodies in motion with every enforcement and every integrator.

    What else the scenes of a class differ in stands in ``kinds``, and on the page beside the parts.
    """
    for parts in moving_parts():
        made = with_parts(
            scene,
            {
                "contact.enforcement": parts["enforcement"],
                **with_integrator(parts["integrator"]),
                "integrator.step": step,
            },
        )
        label = f"{words}, {step:g} s, {parts['enforcement']}, {parts['integrator']}"
        yield HardCase(label, made, judge, {**parts, **(kinds or {})}, slow)
