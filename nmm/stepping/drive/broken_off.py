"""A run that has begun ends in a verdict, whatever its scene turns out to ask for on the way."""

from nmm.errors import NmmError, StorageError
from nmm.stepping.drive.verdict import FAILED, RunVerdict
from nmm.stepping.reports.recorder import Recorder


def broken_off(recorder: Recorder, where: str, fault: NmmError) -> RunVerdict:
    """Return the verdict on a run that a fault has ended, and ``where`` its last step ends.

    Raises
    ------
    NmmError
        The fault, before the first step, and where it is of what is written.
    """
    if not recorder.steps or isinstance(fault, StorageError):
        raise fault
    told = " ".join(str(fault).split())
    return RunVerdict(FAILED, f"broken off at {where}, after {recorder.steps} steps: {told}")
