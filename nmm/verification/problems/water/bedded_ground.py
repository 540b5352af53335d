"""Water and heat in bedded ground, which conducts better along its beds than across."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.stepping.run import Run

# Along the beds, across them (m/s, W/(m K)) and the angle (degrees) at which they rise.
ALONG, ACROSS, RISE = 4e-6, 5e-7, 30.0
LENGTH, HEIGHT, DROP = 3.0, 1.0, 6.0
FLUX = ("seepage:velocity", "heat:flux")
ROUNDING = "linear fields: exact"


def tensor() -> Floats:
    """Conductivity (2, 2)."""
    axis = np.array([np.cos(np.radians(RISE)), np.sin(np.radians(RISE))])
    return np.asarray(ACROSS * np.eye(2) + (ALONG - ACROSS) * np.outer(axis, axis))


@dataclass(frozen=True)
class BeddedLayer(SceneCase):
    """A layer between tight ones whose beds rise: what flows along it presses against its roof.

    With no flow across, ``dh/dy = -k_xy / k_yy dh/dx``, and along it ``(k_xx - k_xy^2 / k_yy)
    dh/dx`` flows. Ends that follow the lines of equal head make this the answer everywhere.
    """

    field: str = "seepage"
    name = "WA17"
    title = "Flow along a confined layer with beds that rise"
    source = "q = det k / k_yy times the slope along the layer (Bear 1972, 5.6)"
    formulations = (
        *("dda", "degree 2", "finite elements", "manifold", "quads", "splines"),
        *("meshless", "manifold degree 2"),
    )
    parameters: ClassVar = {"field": ("seepage", "heat")}
    label: ClassVar[str] = "{0.field}"

    def scene(self) -> str:
        """Return a layer 3 m long and 1 m high, its ends aslant."""
        k, water = tensor(), self.field == "seepage"
        aside = float(HEIGHT * k[0, 1] / k[1, 1])
        corners = [(0, 0), (LENGTH, 0), (LENGTH + aside, HEIGHT), (aside, HEIGHT)]
        key = "hydraulic_conductivity" if water else "conductivity"
        table, amount = ("heads", "head") if water else ("temperatures", "temperature")
        ends = {"in": ([0, 3], DROP), "out": ([1, 2], 0.0)}
        return text.scene(
            f'title = "Bedded layer"\nplane = "strain"\n[{self.field}]\n',
            [
                text.material("shale", 1e9, 0.3, None)
                + f'{key} = {ALONG}\n{key}_2 = {ACROSS}\naxis_angle = "{RISE} deg"\n',
                text.block("layer", "shale", corners),
                text.fixed_edge("base", corners[:2]),
                *(
                    f'[[{table}]]\nname = "{name}"\n{amount} = {value}\n'
                    f"segment = {[list(corners[i]) for i in pair]}\n"
                    for name, (pair, value) in ends.items()
                ),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare what flows, in all and in each element."""
        k = tensor()
        speed = float(np.linalg.det(k)) / k[1, 1] * DROP / LENGTH
        of_elements = run.frames[-1].on("elements")
        flux = next(one.values for name, one in of_elements.items() if name in FLUX)
        off = np.abs(flux - [speed, 0.0]).max() / speed
        taken = run.history[f"{self.field}:taken:in"][-1]
        return {
            "flow": Check(float(taken), speed * HEIGHT, 1e-8, ROUNDING),
            # Means of slopes of rational functions are found by quadrature.
            "flow of elements: error": limit(float(off), 1e-4, ROUNDING),
        }
