"""Notched beam with a cohesive plane at midspan (benchmark C5): peak load by softening and mesh.

python benchmarks/petersson_beam.py --law linear_softening --size 0.0125
"""

import argparse
from time import perf_counter

from nmm import run
from nmm.formulation import Formulation
from nmm.scene.model import Scene

# Peak loads (N) of graded P4 finite elements with the same plane.
REFERENCE = {"linear_softening": 853.0, "bilinear_softening": 753.5}
# Half width of the notch's mouth (m): faces that run together at the tip are no joint.
MOUTH = 1e-6


def beam(law: str, way: float = 6e-4) -> Scene:
    """Span 2 m, height 0.2 m, notch 0.1 m; the middle of the top is pushed down by ``way``."""
    left = [[-1, 0], [-MOUTH, 0], [0, 0.1], [0, 0.2], [-1, 0.2]]
    right = [[MOUTH, 0], [1, 0], [1, 0.2], [0, 0.2], [0, 0.1]]
    concrete = {"young_modulus": 30e9, "poisson_ratio": 0.2}
    plane = {
        "law": law,
        "friction_angle": 0.6,
        "cohesion": 30e6,
        "tensile_strength": 3.33e6,
        "bonded": True,
        "fracture_energy": 124.0,
        "normal_stiffness": 1e14,
    }
    push = {"name": "push", "point": [0, 0.2], "fix": ["y"], "displacement": [0, -way]}
    return Scene.model_validate(
        {
            "title": "Petersson beam",
            "plane": "stress",
            "thickness": 0.05,
            "materials": {"concrete": concrete},
            "interfaces": {"crack": plane},
            "blocks": [
                {"name": "left", "material": "concrete", "vertices": left},
                {"name": "right", "material": "concrete", "vertices": right},
            ],
            "supports": [
                {"name": "fixed", "point": [-1, 0], "fix": ["x", "y"]},
                {"name": "roller", "point": [1, 0], "fix": ["y"]},
                push,
            ],
            "loading": {"until": 1.0},
            "contact": {},
        }
    )


def main() -> None:
    """Run one law on one mesh."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--law", choices=list(REFERENCE), default="linear_softening")
    parser.add_argument("--size", type=float, default=0.0125)
    parser.add_argument("--increment", type=float, default=0.05)
    options = parser.parse_args()
    method = {
        "cover": {"type": "quads", "functions": "monomials", "degree": 0, "size": options.size},
        "contact": {"joint_points": "gauss"},
        "loading": {"increment": options.increment, "tolerance": 1e-3},
    }
    started = perf_counter()
    found = run(beam(options.law), Formulation.model_validate(method))
    peak = float((-found.history["reaction:push:y"]).max())
    reference = REFERENCE[options.law]
    print(found.summary.sentence)
    print(
        f"{options.law}, cells of {options.size} m: peak {peak:.1f} N, reference {reference} N, "
        f"{100 * (peak / reference - 1):+.2f} %, {found.summary.steps} steps, "
        f"{perf_counter() - started:.0f} s"
    )


if __name__ == "__main__":
    main()
