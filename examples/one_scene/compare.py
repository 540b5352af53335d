"""One scene under nine formulations: deflection of the tip, stress, unknowns, seconds."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import nmm

HERE = Path(__file__).parent
FORMULATIONS = (
    "dda",
    "dda_cubic",
    "sub_blocks",
    "rigid_springs",
    "finite_elements",
    "manifold",
    "manifold_quadratic",
    "splines",
    "meshless",
)


@dataclass(frozen=True)
class Result:
    """What one formulation gives.

    Attributes
    ----------
    deflection
        Of the tip over that of beam theory.
    """

    title: str
    deflection: float
    unknowns: int
    seconds: float
    status: str


def beam_theory() -> float:
    """Deflection (m) by bending, shear (factor 5/6) and the joint's springs (Timoshenko)."""
    force, length, height, modulus, nu = 1e5, 4.0, 1.0, 20e9, 0.2
    second_moment, shear_modulus = height**3 / 12, modulus / 2 / (1 + nu)
    bending = force * length**3 / (3 * modulus * second_moment)
    shear = force * length / (5 / 6 * shear_modulus * height)
    turn = force * (length / 2) ** 2 / (50e9 * second_moment)
    slip = force / (20e9 * height)
    return bending + shear + turn + slip


def main(formulations: Sequence[str] = FORMULATIONS) -> dict[str, Result]:
    """Run the scene under each formulation."""
    scene = nmm.read_scene(HERE / "beam.toml")
    found = {}
    for name in formulations:
        formulation = nmm.read_formulation(HERE / "formulations" / f"{name}.toml")
        run = nmm.run(scene, formulation)
        found[name] = Result(
            formulation.title,
            -float(run.history["monitor:end:uy"][-1]) / beam_theory(),
            run.summary.unknowns,
            float(np.sum(list(run.summary.seconds.values()))),
            run.summary.status,
        )
    return found


if __name__ == "__main__":
    for result in main().values():
        print(
            f"{result.title:32} {result.deflection:8.4f} {result.unknowns:7d} unknowns "
            f"{result.seconds:6.2f} s  {result.status}"
        )
