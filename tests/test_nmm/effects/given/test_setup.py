"""What of a scene acts in a stage, which regions a name means, and what pulls alone."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.sparse import csr_array

from nmm.effects.given.resistance import Resistance
from nmm.effects.given.setup import Setup, StageLoads

STAGE = StageLoads(frozenset({"new"}), frozenset({"old"}), driven=frozenset({"jack"}))


@pytest.mark.parametrize(("load", "share"), [("new", 0.25), ("old", 0.75), ("kept", 1.0)])
def test_a_load_grows_fades_or_stays_in_a_stage(load, share):
    assert STAGE.share(load, 0.25) == share


def test_a_load_that_is_new_and_gone_in_one_stage_grows():
    both = StageLoads(frozenset({"pulse"}), frozenset({"pulse"}))
    assert both.share("pulse", 0.25) == 0.25


@pytest.mark.parametrize(
    ("clock", "begin"),
    [
        (False, 3.0),  # time has grown by the load factor since the stage began
        (True, 3.25),  # the clock has stood
    ],
)
def test_a_new_support_is_driven_from_where_it_stood_as_the_stage_began(clock, begin):
    stage = StageLoads(driven=STAGE.driven, clock=clock)
    assert stage.left_behind("jack", 3.25, 0.25) == (0.75, begin)
    assert stage.left_behind("ground", 3.25, 0.25) == (0.0, begin)


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("wall", [True, True, False, False]),
        ("wall.1", [False, True, False, False]),
        ("wall2", [False, False, True, False]),
        ("none", [False, False, False, False]),
    ],
)
def test_a_name_means_a_block_and_the_blocks_of_its_tessellation(name, meant):
    setup = SimpleNamespace(region_name=("wall", "wall.1", "wall2", "base"))
    assert Setup.regions(setup, name).tolist() == meant


@pytest.mark.parametrize("name", [None, "all"])
def test_no_name_means_all_regions(name):
    assert Setup.regions(SimpleNamespace(region_name=("wall",)), name) is None


def test_cables_and_props_are_one_sided_and_bars_are_not():
    rows, limits = csr_array((3, 6)), np.array([[0.0, 5e3], [-5e3, 0.0], [-5e3, 5e3]])
    bond = csr_array((0, 3))
    zero = np.zeros(3)
    links = Resistance(rows, rows, *limits.T, zero, zero, bond, np.zeros(0))
    assert links.one_sided.tolist() == [True, True, False]
