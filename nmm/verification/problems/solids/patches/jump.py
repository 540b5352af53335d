"""The patch test of two halves that springs tie."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from nmm.verification import text
from nmm.verification.base import MESHES, Check, Checks, SceneCase
from nmm.verification.reading import last_way

if TYPE_CHECKING:
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class Jump(SceneCase):
    """A body split in two and tied by springs opens by traction over stiffness.

    The parts carry the traction undisturbed, whatever covers they have and whether their meshes
    match.
    """

    name = "A1 jump"
    title = "Split patch tied by springs"
    source = "Jump t / k, elongation t (L / E + 1 / k)"
    formulations = ("dda", "degree 2", *MESHES)
    stiffness: float = 4.0
    # A soft and a stiff joint, and glue.
    parameters: ClassVar = {"stiffness": (4.0, 4e3, float("inf"))}

    @property
    def variant(self) -> str:
        return f"k = {self.stiffness:g} Pa/m" if self.stiffness < float("inf") else "glued"

    def scene(self) -> str:
        """Return two unit squares of E = 1 under a pull of 1 Pa."""
        bond: dict[str, float | bool] = {"bonded": True}
        if self.stiffness < float("inf"):
            bond |= {"normal_stiffness": self.stiffness, "shear_stiffness": self.stiffness / 2}
        return text.scene(
            'title = "Split patch"\nplane = "stress"\n',
            [
                text.material("soft", modulus=1.0, poisson=0.0, density=None),
                text.interface("joint", 0.0, more=bond),
                text.box("left", (0, 0), (1, 1), "soft"),
                text.box("right", (1, 0), (1, 1), "soft"),
                text.fixed_edge("wall", [[0, 0], [0, 1]]),
                text.pulled_edge("pull", [[2, 0], [2, 1]], [1, 0]),
                text.monitor("root", (0, 0.5), "left"),
                text.monitor("near", (1, 0.5), "left"),
                text.monitor("far", (1, 0.5), "right"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        near, far = last_way(run, "near")[0], last_way(run, "far")[0]
        reason = "residual 1e-8 of the solution, relative to the forces of all unknowns"
        stress = run.stress[:, 0]
        allowed = 1e-7 if self.stiffness < float("inf") else 1e-9
        return {
            "jump (m)": Check(far - near, 1 / self.stiffness, allowed, reason),
            "elongation on the left (m)": Check(near - last_way(run, "root")[0], 1.0, 1e-7, reason),
            "smallest stress (Pa)": Check(float(stress.min()), 1.0, 1e-7, reason),
            "largest stress (Pa)": Check(float(stress.max()), 1.0, 1e-7, reason),
        }
