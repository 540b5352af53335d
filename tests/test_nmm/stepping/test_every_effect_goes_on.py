"""Every effect goes on from a checkpoint bit by bit, and over a change of its covers.

Scenes are those whose files are spoilt elsewhere: small ones that together name every table.
"""

import tomllib

import pytest

from nmm.errors import NmmError
from nmm.model.called_for import called_for
from nmm.model.effects_table import EFFECTS, GLUE
from nmm.scene import build_scene
from nmm.stepping.prepare import prepare
from nmm.testing.resumed.stopping import check_goes_on
from nmm.verification.hard.spoilt.mutations import sound_files

# Loads that come on in one step are brought on in increments; weight alone has none, and these
# scenes go on over stages alone. Splitting takes minutes, and goes on beside its own tests.
INCREMENTS = ("loaded", "zones")
ONE_STEP = ("cracked", "jointed", "nets", "joints under water", "splitting")
# A path past the peak stores no checkpoint, nor do searches for a factor of safety.
WITHOUT = ("softening", "opened", "yielding")
SCENES = sorted(
    name
    for name, (kind, _) in sound_files().items()
    if kind == "scene" and "/" not in name and name not in WITHOUT
)
# Growing cracks go on in stages too, beside the other scenes that are stopped.
SLOW = ("growing", "pulled", "rolled over", "splitting")
# What says by line that it knows loads of one factor.
REFUSED = ("growing",)


def tables(name):
    """Return the tables of a scene that stores a checkpoint after each step."""
    made = tomllib.loads(sound_files()[name][1])
    made.setdefault("output", {})["checkpoint"] = {"every_steps": 1}
    if name in INCREMENTS:
        made["loading"] = {"until": 1.0}
        made.setdefault("formulation", {})["loading"] = {"increment": 0.25}
    return made


def in_stages(name):
    """Return the same in two stages, in the second of which cells are other."""
    made = tables(name)
    made.pop("loading", None)
    duration = made.pop("duration", None)
    cover = made.get("formulation", {}).get("cover", {})
    stages = [{"name": "first"}, {"name": "second"}]
    if "size" in cover:
        stages[1]["cover"] = {"size": 0.8 * cover["size"]}
    if duration is not None:
        # 1.2 s and "20 ms" alike
        seconds = build_scene(tables(name), name).duration
        stages = [{**one, "duration": seconds / 2} for one in stages]
    return {**made, "stages": stages}


def named(made):
    """Return the effects that tables name."""
    scene = build_scene(made, "scene")
    glue = {GLUE} if "sub_blocks" in str(made.get("formulation")) else set()
    return {name for name, wanted in called_for(scene).items() if wanted} | glue


def posed(made):
    scene = build_scene(made, "scene")
    return prepare(scene, scene.formulation)


def marked(names, quick=()):
    slow = set(SLOW) - set(quick)
    return [pytest.param(n, marks=pytest.mark.slow) if n in slow else n for n in names]


@pytest.mark.parametrize("name", marked(n for n in SCENES if n not in ONE_STEP))
def test_a_run_goes_on_from_a_checkpoint_bit_by_bit(name, tmp_path):
    check_goes_on(build_scene(tables(name), "scene"), tmp_path)


STAGED = [name for name in SCENES if name not in ("creeping", "splitting", "staged")]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", marked(STAGED, quick=REFUSED))
def test_a_run_goes_on_over_a_change_of_covers_bit_by_bit_or_is_refused_by_line(name, tmp_path):
    made = in_stages(name)
    if name in REFUSED:
        with pytest.raises(NmmError, match=r"scene: .*stages"):
            posed(made)
        return
    whole = check_goes_on(build_scene(made, "scene"), tmp_path)
    assert whole.summary.status == "converged", whole.summary.sentence


def test_together_the_scenes_name_every_effect():
    """Those that are missing here are stopped and gone on with beside their own tests."""
    elsewhere = {"changed materials", "fracture in time"}
    found = set().union(*(named(tables(name)) for name in SCENES))
    assert set(EFFECTS.table) - found == elsewhere
