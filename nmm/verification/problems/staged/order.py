"""What is taken away: in either order, from under a beam, off a stack."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit
from nmm.verification.problems.staged.columns import ends

if TYPE_CHECKING:
    from nmm.stepping.run import Run


class TwoHoles(SceneCase):
    """Two holes are dug in elastic ground under stress: which is first leaves no trace."""

    name = "ST4 order"
    title = "Two holes dug in either order"
    source = "Superposition: linear ground knows no order"
    formulations = ("quads",)

    def scene(self) -> str:
        """Return the ground whose first hole is the left one."""
        return self._scene("left", "right")

    def _scene(self, first: str, then: str) -> str:
        places = {"left": (-1.5, -0.6), "right": (1.0, 0.3)}
        holes = {key: text.rectangle(at, (at[0] + 0.7, at[1] + 0.5)) for key, at in places.items()}
        outline = text.rectangle((-3, -2), (3, 2))
        inside = [hole.tolist() for hole in holes.values()]
        return text.scene(
            'title = "Two holes"\nplane = "strain"\n',
            [
                text.material("rock", 10e9, 0.25, None),
                text.interface("any", 30.0, more={"bonded": True}),
                text.block("ground", "rock", outline) + f"holes = {inside}\n",
                *(text.block(key, "rock", hole) for key, hole in holes.items()),
                '[[initial_stresses]]\nblock = "all"\nstress = [-5e6, -10e6, 1e6]\n',
                *(
                    text.fixed_edge(f"side {n}", np.array(side).tolist())
                    for n, side in enumerate(
                        zip(outline, np.roll(outline, -1, axis=0), strict=True)
                    )
                ),
                '[[stages]]\nname = "in place"\n',
                f'[[stages]]\nname = "one"\nremove = ["{first}"]\n',
                f'[[stages]]\nname = "both"\nremove = ["{then}"]\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        # A second run, which no other case needs.
        from nmm.scene import parse_scene
        from nmm.stepping.run import run as run_scene

        scene = parse_scene(self._scene("right", "left"), "other order")
        other = run_scene(scene, self.formulation(scene, "quads"))
        moved, stress = run.displacement, run.stress
        reason = "rounding"
        return {
            "displacement, over the largest": limit(
                float(np.abs(moved - other.displacement).max() / np.abs(moved).max()), 1e-10, reason
            ),
            "stress, over the largest": limit(
                float(np.abs(stress - other.stress).max() / np.abs(stress).max()), 1e-10, reason
            ),
        }


class MiddleSupport(SceneCase):
    """A beam of two spans stands on three supports; then the middle one is taken away."""

    name = "ST4 beam"
    title = "A beam loses its middle support"
    source = "Slender beams: 3/8, 5/4, 3/8 of q l, then 1, 0, 1"
    formulations = ("quads degree 2",)
    span = 20.0
    load = 1e3

    def scene(self) -> str:
        """Return the beam, 1 m high, on its three points."""
        places = {"left": 0.0, "middle": self.span, "right": 2 * self.span}
        top = [(0.0, 1.0), (2 * self.span, 1.0)]
        return text.scene(
            'title = "Beam"\nplane = "stress"\n[formulation.loading]\nincrement = 1.0\n',
            [
                text.material("steel", 2e11, 0.0, None),
                text.block("beam", "steel", text.rectangle((0, 0), (2 * self.span, 1))),
                *(
                    f'[[supports]]\nname = "{name}"\npoint = [{x}, 0]\n'
                    + ('fix = ["x", "y"]\n' if name == "left" else 'fix = ["y"]\n')
                    for name, x in places.items()
                ),
                text.pulled_edge("q", top, [0, -self.load]),
                '[[stages]]\nname = "three"\n',
                '[[stages]]\nname = "two"\nsupports = ["left", "right"]\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        whole, checks = self.load * self.span, {}
        three, two = ends(run, 2)
        shear = "a beam of two spans gives by shear as well, of order (h / l)^2"
        for name, first, then in (
            ("left", 0.375, 1.0),
            ("middle", 1.25, 0.0),
            ("right", 0.375, 1.0),
        ):
            force = run.history[f"reaction:{name}:y"] / whole
            checks[f"{name} of three (q l)"] = Check(float(force[three]), first, 5e-3, shear, 1.0)
            if then:
                checks[f"{name} of two (q l)"] = Check(float(force[two]), then, 1e-6, "statics")
        return checks


class UnloadedStack(SceneCase):
    """The two highest of five blocks are lifted off: what stands carries so much less."""

    name = "ST4 stack"
    title = "Blocks lifted off a stack"
    source = "Balance of weights"
    formulations = ("dda", "rigid", "quads")
    density = 2600.0

    def scene(self) -> str:
        """Return five cubes, the lowest held, in two stages."""
        return text.scene(
            'title = "Stack"\nplane = "stress"\n[gravity]\n[contact]\n',
            [
                text.material("rock", density=self.density),
                text.interface("contact", 30.0),
                *(text.box(f"block {n}", (0, n), (1, 1)) for n in range(5)),
                text.fixed_edge("ground", [[0, 0], [1, 0]]),
                '[[stages]]\nname = "five"\n',
                '[[stages]]\nname = "three"\nremove = ["block 3", "block 4"]\n',
            ],
        )

    def measure(self, run: "Run") -> Checks:
        carried = run.history["reaction:ground:y"] / (self.density * text.G)
        return {
            f"blocks of the stage of {n}": Check(float(carried[row]), n, 1e-8, "as solved")
            for n, row in zip((5, 3), ends(run, 2), strict=True)
        }
