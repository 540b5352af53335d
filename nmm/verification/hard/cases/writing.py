"""Tables of scenes, as the generators of hard cases write them."""

from typing import Any

import numpy as np
import numpy.typing as npt

from nmm.verification.hard.cases.base import Document


def rock(
    modulus: float = 20e9, poisson: float = 0.2, density: float = 2600.0, friction: float = 0.0
) -> Document:
    """Tables of one material and of the contact of all blocks; ``friction`` in degrees."""
    return {
        "plane": "strain",
        "materials": {
            "rock": {"young_modulus": modulus, "poisson_ratio": poisson, "density": density}
        },
        "interfaces": {"contact": {"friction_angle": float(np.deg2rad(friction))}},
        "contact": {},
    }


def block(name: str, vertices: npt.ArrayLike, material: str = "rock") -> Document:
    """Table of a block."""
    points = np.asarray(vertices, dtype=float).tolist()
    return {"name": name, "material": material, "vertices": points}


def supported(*names: str) -> list[Document]:
    """Return tables of supports that hold whole blocks."""
    return [{"name": f"hold {name}", "block": name, "fix": ["x", "y"]} for name in names]


def in_time(scene: Document, step: float, steps: int, gravity: float | None = 9.81) -> Document:
    """Return a scene with inertia, of so many steps (s); without weight where it is None."""
    made: dict[str, Any] = {**scene, "inertia": {}, "duration": steps * step}
    if gravity is not None:
        made["gravity"] = {"acceleration": [0.0, -gravity]}
    made["formulation"] = {**scene.get("formulation", {}), "integrator": {"step": step}}
    return made
