"""The frame of a run that a picture shows."""

from nmm.errors import NmmError
from nmm.results.frame import Frame
from nmm.results.sink import RunData


def frame_of(run: RunData, number: int) -> Frame:
    """Return a frame by its number, counted from the end when negative.

    Raises
    ------
    TypeError
        When ``run`` has no frames, such as the name of a folder.
    NmmError
        When there is no such frame.
    """
    if not hasattr(run, "frames"):
        raise TypeError(f"{run!r}: expected a run: read a folder by nmm.read_run(path)")
    count = len(run.frames)
    if not -count <= number < count:
        raise NmmError(
            f"frame {number}: expected one of the {count} frames of this run: give a number from 0 "
            f"to {count - 1}, or from -1 on backwards from the end"
            if count
            else f"frame {number}: this run has no frames: expected one at least: run it again"
        )
    return run.frames[number]
