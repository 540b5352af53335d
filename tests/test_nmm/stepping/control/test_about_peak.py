"""The largest load between two steps of a path, on paths whose peak is known."""

from types import SimpleNamespace

import pytest

from nmm.controls.dissipation import Dissipation
from nmm.stepping.control.about_peak import AboutPeak, refined
from nmm.stepping.control.position import OnPath
from nmm.stepping.drive.verdict import FAILED, FAILURE, RunVerdict

PEAK, STEP = 30.0, 0.01


def place(gone, load):
    state = SimpleNamespace(load_factor=load(gone))
    return OnPath(state, None, STEP, None, gone)


def walk(at, control, about, load):
    """Go on along a path by steps of one length, up to the end of the control."""
    gone = at.gone
    while gone < control.end * (1 - 1e-9):
        gone += control.increment
        about.see(place(gone, load), None)
    return RunVerdict(FAILURE, "", about.most, 0.0)


def found(load, follow):
    start = place(0.0, load)
    about, control = AboutPeak(start, None), Dissipation(STEP, end=0.15)
    walk(start, control, about, load)
    return about.most, refined(about, control, follow)


@pytest.mark.parametrize("top", [0.0712, 0.075, 0.0788])
@pytest.mark.parametrize("corner", [True, False])
def test_a_peak_between_two_steps_is_found_to_2e_4(top, corner):
    """A corner whose flanks fall by 5e-3 in half a step, and a parabola that falls as much."""

    def load(gone):
        away = abs(gone - top) / (STEP / 2)
        return PEAK * (1 - 5e-3 * (away if corner else away**2))

    coarse, fine = found(load, lambda at, record, control, about: walk(at, control, about, load))
    assert coarse < PEAK * (1 - 2.5e-4)
    assert fine == pytest.approx(PEAK, rel=2e-4)


def test_where_shorter_steps_find_no_balance_the_load_of_the_longer_ones_stays():
    lost = RunVerdict(FAILED, "no balance", 0.0)
    coarse, fine = found(lambda gone: PEAK - abs(gone - 0.0712), lambda *what: lost)
    assert fine == coarse


@pytest.mark.parametrize(
    ("loads", "ways", "through"),
    [
        ([1.0, 2.0, 3.0, 2.5], [0, 1, 1, 1], 2.0),
        ([1.0, 2.0, 3.0, 2.5], [0, 0, 1, 1], None),
        ([1.0, 3.0, 2.0, 2.5], [0, 0, 1, 1], None),
    ],
)
def test_a_path_leads_through_an_unstable_place_where_its_load_grows_beyond(loads, ways, through):
    start = OnPath(SimpleNamespace(load_factor=0.5), None, STEP, None)
    about, most = AboutPeak(start, None), 0.0
    for load, many in zip(loads, ways, strict=True):
        most = max(most, load)
        at = OnPath(SimpleNamespace(load_factor=load), None, STEP, None, peak=most)
        about.see(at, None, many)
    assert about.through == through
