"""Bodies that flow: a bar, a beam that bends, a thick cylinder under inner pressure."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.formulation import Formulation
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.formulations import with_cover
from nmm.verification.reading import converged, way

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.stepping.run import Run


def flowing(yields: float, modulus: float, poisson: float, hardens: float = 0.0) -> str:
    """Table of a material "steel" of von Mises."""
    return (
        f'[materials.steel]\nlaw = "von_mises"\nyoung_modulus = {modulus!r}\n'
        f"poisson_ratio = {poisson!r}\nyield_stress = {yields!r}\nhardening_modulus = {hardens!r}\n"
    )


class PlasticBar(SceneCase):
    """A bar is pulled beyond its yield stress and let go: it keeps its plastic strain.

    A block of discontinuous deformation analysis, one material point at its centroid, does as the
    meshes do.
    """

    name = "PL0 bar"
    title = "Bar pulled beyond yield and let go"
    source = "strain sigma / E + (sigma - Y) / H under load, (sigma - Y) / H after"
    formulations = ("dda", "degree 2", "finite elements", "manifold", "quads degree 2")
    stress = 300.0
    yields = 250.0
    hardens = 2e4
    modulus = 2e5

    def scene(self) -> str:
        """Return the bar, 2 by 1, with a load that grows over one unit and falls over the next."""
        history = "history = [[0, 0], [1, 1], [2, 0]]\n"
        return text.scene(
            'title = "Bar beyond yield"\nplane = "stress"\n',
            [
                flowing(self.yields, self.modulus, 0.3, self.hardens),
                text.box("bar", (0, 0), (2, 1), "steel"),
                text.fixed_edge("left", [(0, 0), (0, 1)], "x"),
                text.fixed_point("pin", [0, 0], "y"),
                text.pulled_edge("pull", [(2, 0), (2, 1)], [self.stress, 0]) + history,
                text.monitor("root", (0, 0.5), "bar"),
                text.monitor("tip", (2, 0.5), "bar"),
                "[loading]\nuntil = 2.0\nscaled = []\n",
                # Twelfths: the yield stress is met at the end of an increment.
                f"[formulation.loading]\nincrement = {1 / 12!r}\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        strain = (way(run, "tip") - way(run, "root"))[:, 0] / 2
        top = int(np.argmin(np.abs(run.history["load_factor"] - 1)))
        plastic = (self.stress - self.yields) / self.hardens
        # The work of both stresses' mean over the plastic strain less what hardening stores.
        lost = 2 * self.yields * plastic
        exact = "one stress in the whole bar"
        return {
            "strain under load": Check(
                strain[top], self.stress / self.modulus + plastic, 1e-8, exact
            ),
            "strain after it": Check(strain[-1], plastic, 1e-8, exact),
            "energy lost (J)": Check(run.history["material_loss"][-1], lost, 1e-8, exact),
            "at rest": holds(converged(run), "every increment is in equilibrium"),
        }


class PlasticBeam(SceneCase):
    """A beam under two loads fails at one and a half of the moment at which it first yields.

    Half of it is modelled. Between the loads the moment is constant and nothing shears.
    """

    name = "PL0 beam"
    title = "Plastic limit of a beam in bending"
    source = "M = Y h^2 / 4 = 1.5 M_yield; curvature M_y / (E I) / sqrt(3 - 2 M / M_y)"
    formulations = ("manifold", "manifold degree 2", "quads degree 2")
    lever = 6.0
    slow = True

    def formulation(self, scene: "Scene", name: str) -> Formulation:
        """Return cells of a quarter of the depth, of half of it for functions of degree 2."""
        return with_cover(super().formulation(scene, name), size=0.25 if "2" not in name else 0.5)

    def scene(self) -> str:
        """Return half the beam, 9 long and 1 deep: a load of 1 J / 6 m is the first yield."""
        force = 1 / 6 / self.lever
        return text.scene(
            'title = "Beam that flows"\nplane = "stress"\n',
            [
                flowing(1.0, 1000.0, 0.3),
                text.block("beam", "steel", [(0, 0), (9, 0), (9, 1), (3.5, 1), (2.5, 1), (0, 1)]),
                text.fixed_edge("middle", [(0, 0), (0, 1)], "x"),
                text.fixed_point("pin", [0, 0.5], "y"),
                text.pulled_edge("end", [(9, 0), (9, 1)], [0, force]),
                text.pulled_edge("load", [(2.5, 1), (3.5, 1)], [0, -force]),
                text.monitor("middle", (0, 0.0), "beam"),
                text.monitor("bent", (2, 0.0), "beam"),
                '[loading]\nuntil = "failure"\nmaximum_factor = 3.0\n',
                "[formulation.loading]\nincrement = 0.1\ntolerance = 0.005\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        at = run.history["load_factor"]
        step = int(np.argmin(np.abs(at - 1.4)))
        bow = (way(run, "bent") - way(run, "middle"))[step, 1]
        curvature = 2 * 1.0 / 1000.0 / np.sqrt(3 - 2 * at[step])
        limit = "the bracket of 0.5 %, and a displacement method's limit from above"
        return {
            "limit load over first yield": Check(
                run.summary.failure_factor or np.nan, 1.5, 0.02, limit
            ),
            "bow over 2 m at 1.4 (m)": Check(
                float(bow), curvature * 2, 0.05, "the edge of the yielded zone lies within cells"
            ),
            "a mechanism": holds(
                run.summary.status == "failure_load", "failing is shown to be the structure's"
            ),
        }
