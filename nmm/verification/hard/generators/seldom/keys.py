"""Random scenes with one to three keys that the others never have."""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.generators.scenes.possible import possible
from nmm.verification.hard.generators.scenes.scenes import standing
from nmm.verification.hard.generators.scenes.site import Site, merged
from nmm.verification.hard.generators.seldom import (
    acting,
    approximated,
    matter,
    run,
    shapes,
    waters,
)
from nmm.verification.hard.oracles.seen_again import ways
from nmm.verification.hard.oracles.whole import sound

Added = Callable[[Document, Site], Document]
"""Returns tables that join a scene: a list named ``blocks!`` takes the place of ``blocks``.

Empty where what is added has no place there.
"""

KINDS = ("rest", "time", "failure", "creep", "safety", "stages")

ADDED: tuple[Added, ...] = (
    *(matter.softening, matter.cut_off, matter.out_of_plane, matter.along_axes),
    *(matter.of_two_rocks, matter.slid, matter.leaky),
    *(acting.point_support, acting.held_block, acting.moved_by_a_field, acting.load_of_a_field),
    *(acting.pressed_all_round, acting.stress_by_depth, waters.water_lines, waters.fluxes),
    *(waters.slopes_of_heads, waters.seeping, waters.stored_in_joints, acting.ratios),
    *(waters.seasons, waters.by_stages, acting.free_columns, shapes.tessellated),
    *(acting.far_ground, acting.held_back),
    *(run.growth, run.split_at_elements, run.scaled, run.staged, shapes.holed, shapes.jointed),
    *(approximated.net, approximated.regions, approximated.own_net, approximated.enriched),
    *(approximated.springs, approximated.stiffness, approximated.in_time, approximated.diffused),
    *(approximated.solved, approximated.stored, approximated.pieces),
)
"""What may be added."""

ANYWHERE = (
    *(acting.point_support, acting.held_block, acting.moved_by_a_field, acting.load_of_a_field),
    *(acting.pressed_all_round, acting.stress_by_depth, waters.water_lines),
    *(approximated.solved, approximated.stored),
)
"""Of them, those that fit nearly any scene: a quarter as likely as each of the others."""

TURNED = ("turn by 37 deg", "mirror")
SHIFTED = ("shift", "shift up")


class SeldomKeys(HardClass):
    """One random scene a seed, with keys that no scene of the class ``scenes`` has."""

    name = "keys"
    title = "random scenes with seldom keys: fields, softening, nets, fluxes, stages, options"
    oracle = "those of `scenes`"
    share = 100

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield the scene of a seed."""
        random = np.random.default_rng([seed, 98])
        scene, parts, site = standing(random, str(random.choice(KINDS)))
        fit = [add for add in ADDED if add(scene, site)]
        chosen = _drawn(fit, random)
        for add in sorted(chosen, key=lambda one: one is shapes.tessellated):
            scene = joined(scene, add(scene, site))
        scene = possible(scene)
        seen = str(random.choice(list(_ways(scene))))
        names = [add.__name__.replace("_", " ") for add in chosen]
        label = f"seed {seed}, {site.kind}, {', '.join([*parts.values(), *names])}, {seen}"
        kinds = {**parts, "kind": site.kind, **{f"key {name}": name for name in names}}
        yield HardCase(label, scene, partial(sound, way=seen), kinds)


def joined(scene: Document, tables: Document) -> Document:
    """Return a scene with what is added to it."""
    new = {key: value for key, value in tables.items() if not key.endswith("!")}
    instead = {key[:-1]: value for key, value in tables.items() if key.endswith("!")}
    return {**merged(scene, new), **instead}


def _drawn(fit: list[Added], random: np.random.Generator) -> list[Added]:
    shares = np.array([0.25 if add in ANYWHERE else 1.0 for add in fit])
    count = min(len(fit), int(random.integers(1, 4)))
    places = random.choice(len(fit), size=count, replace=False, p=shares / shares.sum())
    return [fit[place] for place in places]


def _ways(scene: Document) -> Iterator[str]:
    """Yield the ways of `scenes` in which what was added has an image."""
    without = set[str]()
    supports = scene.get("supports", [])
    if any("field" in table for table in [*scene.get("loads", []), *supports]):
        # Expressions have no unit, and stay where they are.
        without |= {"mm, N, s", "powers of two", "times -2.5", *SHIFTED, *TURNED}
    if any("surface" in table for table in scene.get("initial_stresses", [])):
        without |= {"times -2.5", *TURNED}
    if "joint_sets" in scene:  # laid from one corner of a box about the blocks
        without |= {*SHIFTED, *TURNED}
    levels = [*scene.get("heads", []), *scene.get("joint_heads", [])]
    if any("history" in table for table in levels):  # histories scale levels, wherever they are
        without |= {"shift up"}
    if "tessellations" in scene:  # seeds are drawn in an upright box
        without |= set(TURNED)
    if any(len(table["fix"]) < 2 for table in supports):
        without |= {"turn by 37 deg"}
    yield from (way for way in ways(scene) if way not in without)
