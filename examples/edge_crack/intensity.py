"""Stress intensity factors of the plate with an edge crack."""

from pathlib import Path

from nmm.fracture.stress_intensity import StressIntensity, stress_intensity
from nmm.model.build import material_law
from nmm.scene import read_scene
from nmm.stepping.run import run


def main(radius: float = 0.3) -> StressIntensity:
    """Run the scene and return the factors at its tip, from a domain of this radius (m)."""
    scene = read_scene(Path(__file__).with_name("plate.toml"))
    found = run(scene)
    law = material_law(scene.materials["plate"])
    return stress_intensity(
        found.stepper.model,
        found.state.deformation,
        0,
        radius,
        kappa=law.kolosov(scene.plane),
    )


if __name__ == "__main__":
    factors = main()
    print(f"K_I = {factors.opening:.4f}, K_II = {factors.sliding:.1e} (reference 3.5412, 0)")
