"""An output of one's own: how far each body has turned."""

import numpy as np

from nmm.outputs.base import Output, View
from nmm.quantity import Quantity


class Tilt(Output):
    """Rotation of each body (rad), counter-clockwise; the largest is a column of the history."""

    def fields(self, view: View) -> dict[str, Quantity]:
        """See `Output.fields`."""
        frames = view.state.frames
        tilt = frames.angle if frames.tilt is None else frames.angle + frames.tilt
        mean = view.model.rigid_projection @ view.state.deformation
        return {"tilt": Quantity("bodies", tilt + np.reshape(mean, (-1, 3))[:, 2], "rad")}

    def history(self, view: View) -> dict[str, float]:
        """See `Output.history`."""
        return {"largest_tilt": float(np.abs(self.fields(view)["tilt"].values).max())}
