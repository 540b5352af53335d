"""Draw the bridge at its worst moment, and its thrust as the load crosses.

python examples/arch_bridge/draw.py runs/bridge
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import nmm
from nmm import plots

HERE = Path(__file__).parent
SPEED, START = 12.0, -7.412659
"""Of the load (m/s), and where it sets out (m)."""


def main(folder: str) -> None:
    """Draw both pictures into the folder of this file."""
    run = nmm.read_run(folder)
    place = START + SPEED * run.history["time"]
    thrust = run.history["reaction:west:x"] / 1e3
    times = np.array([frame.time for frame in run.frames])
    quarter = int(np.argmin(np.abs(START + SPEED * times + 2.5)))
    plots.deformed(run, frame=quarter, magnification=500, path=HERE / "quarter.png")
    fig, ax = plt.subplots(figsize=(6, 3), layout="constrained")
    ax.plot(place, thrust)
    ax.set(xlabel="place of the load (m)", ylabel="thrust at the west (kN)")
    fig.savefig(HERE / "thrust.png", dpi=120)


if __name__ == "__main__":
    main(sys.argv[1])
