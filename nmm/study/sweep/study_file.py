"""Study files: which scenes are run under which formulations with which values."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import Field

from nmm.errors import NmmError
from nmm.formulation import Formulation
from nmm.scene import read_scene
from nmm.scene.document import parse, read_text
from nmm.scene.fields import Count, Frozen, Text
from nmm.study.cases.quantities import check_quantity_name
from nmm.study.cases.variants import StudyCase, cases_of, read_formulations


class StudyPlan(Frozen):
    """A study: scenes, formulations, values by dotted key, and what is read off each run."""

    title: Text = Field(default="", description="a title", examples=["Kitoh, 12 seeds"])
    scene: Text = Field(
        default="",
        description="the path of a scene file, from the study's folder",
        examples=["beam.toml"],
    )
    scenes: tuple[Text, ...] = Field(
        default=(),
        description="a list of paths of scene files, in place of one",
        examples=[["small.toml", "large.toml"]],
    )
    formulations: tuple[Text, ...] = Field(
        default=(), description="a list of paths of formulation files", examples=[["dda.toml"]]
    )
    vary: dict[Text, tuple[Any, ...]] = Field(
        default={},
        description='a table [vary] of lists by dotted key, as "tessellations.0.seed" = [1, 2]',
    )
    quantities: tuple[Text, ...] = Field(
        default=("energy",), description="a list of quantities", examples=[["failure_load"]]
    )
    over: tuple[Text, ...] = Field(
        default=(),
        description="a list of varied keys that make an ensemble: means are taken over them",
        examples=[["tessellations.0.seed"]],
    )
    repeats: Count = Field(default=1, gt=0, description="repeats of each case, > 0", examples=[1])


def read_plan(path: Path) -> tuple[StudyPlan, list[StudyCase]]:
    """Read a study file and return it with its cases, none twice.

    Raises
    ------
    NmmError
        Faults of the study file, of the scene, of a formulation, or of a value in ``[vary]``.
    """
    plan = parse(read_text(path, NmmError), StudyPlan, str(path), NmmError)[0]
    if bool(plan.scene) == bool(plan.scenes):
        raise NmmError(
            f"{path}: scene: {'scenes too' if plan.scene else 'none'}: expected one scene, or a "
            "list scenes: name what is to be run"
        )
    strange = [key for key in plan.over if key not in plan.vary]
    if strange:
        known = ", ".join(plan.vary) or "which is empty"
        raise NmmError(
            f"{path}: over: {strange[0]}: expected a key of [vary] ({known}): correct it"
        )
    cases = [
        one
        for name in plan.scenes or (plan.scene,)
        for one in _cases(path.resolve().parent, plan, name)
    ]
    return plan, cases


def _cases(folder: Path, plan: StudyPlan, name: str) -> list[StudyCase]:
    """Cases of one scene; of several, the scene's file is the first of their settings."""
    scene = read_scene(folder / name)
    kinds = read_formulations([folder / item for item in plan.formulations])
    if not kinds:
        own = scene.formulation or Formulation()
        kinds = {own.title or "scene's own": own}
    for quantity in plan.quantities:
        check_quantity_name(scene, quantity)
    cases = cases_of(scene, kinds, plan.vary)
    if not plan.scenes:
        return cases
    named = {"scene": Path(name).stem}
    return [replace(one, settings=named | dict(one.settings)) for one in cases]
