"""What holds a resumed run to the whole one tells one number of a difference, and where it is."""

import json
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from nmm.testing.resumed.stopping import StoppedError, check_resumed, interrupting


@dataclass(frozen=True)
class Frame:
    index: int
    time: float
    points: np.ndarray
    fields: dict[str, Any]
    stage: str = ""


@dataclass(frozen=True)
class Run:
    """What of a run is compared, in the place of one."""

    told: dict[str, Any]
    displacement: np.ndarray
    history: dict[str, np.ndarray]
    frames: list[Frame]

    @property
    def summary(self):
        return SimpleNamespace(to_json=lambda: json.dumps(self.told))


def frame(value=2.0):
    return Frame(1, 0.5, np.zeros((3, 2)), {"pore": SimpleNamespace(values=np.array([value]))})


WHOLE = Run(
    {"steps": 10, "seconds": {"solve": 1.0}, "effect_seconds": {}, "peak_memory": 1},
    np.array([[1e-3, 0.0]]),
    {"time": np.array([0.0, 0.5]), "error": np.array([np.nan, 1e-3])},
    [frame()],
)


def test_runs_that_differ_in_seconds_and_memory_alone_are_the_same():
    check_resumed(WHOLE, replace(WHOLE, told=WHOLE.told | {"seconds": {}, "peak_memory": 7}))


@pytest.mark.parametrize(
    ("words", "changed"),
    [
        ("another steps: 11, not 10", {"told": WHOLE.told | {"steps": 11}}),
        ("other entries of the summary", {"told": WHOLE.told | {"more": 1}}),
        ("other displacements", {"displacement": np.array([[1e-3, 1e-19]])}),
        ("other columns of the history", {"history": {"time": np.array([0.0, 0.5])}}),
        (
            "another column error",
            {"history": WHOLE.history | {"error": np.array([np.nan, 1e-3 + 1e-18])}},
        ),
        ("another number of frames", {"frames": []}),
        ("another time of frame 1", {"frames": [replace(frame(), time=0.25)]}),
        ("another field pore of frame 1", {"frames": [frame(np.nextafter(2.0, 3.0))]}),
    ],
)
def test_one_number_of_a_difference_is_told_by_its_place(words, changed):
    with pytest.raises(AssertionError, match=f"resumed: {words}"):
        check_resumed(WHOLE, replace(WHOLE, **changed))


def test_a_run_is_stopped_after_as_many_steps_as_asked():
    progress = interrupting(2)
    for share in (0.0, 0.5):
        progress(share, "")
    with pytest.raises(StoppedError):
        progress(1.0, "")
