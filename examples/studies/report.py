"""Write the report on what accuracy costs anew: all studies of `docs/accuracy_cost`.

``python examples/studies/report.py docs/accuracy_cost`` takes about half an hour of one processor;
names after the folder choose studies. Records are measured in one session: run it on a machine that
does nothing else, and read the ratio of wall to processor seconds that each page states.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from nmm.study.threads import one_thread

one_thread()  # before numpy is imported

HERE = Path(__file__).resolve().parent
SIZE = "formulation.cover.size"
BODIES = ("dda", "dda_2", "dda_3", "sub_blocks")
BODIES += ("nmm_triangles_0", "nmm_triangles_1", "nmm_triangles_2")
BODIES += ("nmm_quads_0", "nmm_quads_1", "nmm_quads_2", "mls")
ELEMENTS = ("P1", "P2", "P3")
STEP = "formulation.integrator.step"
INTEGRATORS = ("shi", "newmark", "generalized_alpha")
ENFORCEMENTS = ("penalty", "augmented", "lagrange", "cone", "barrier")


@dataclass(frozen=True)
class Study:
    """One page of the report: a scene, formulation files by name, values by dotted key.

    ``common`` are tables that all formulations get; ``zero`` says why the quantity should be zero.
    """

    scene: str
    formulations: tuple[str, ...]
    vary: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    common: Mapping[str, Any] = field(default_factory=dict)
    quantity: str = "external_work"
    yardstick: tuple[str, ...] = ()
    exponent: float | None = None
    zero: str = ""


def body(scene: str, sizes: Sequence[float], *more: str, exponent: float | None = None) -> Study:
    """Return the study of one elastic body under every cover, beside scikit-fem.

    The exponent is that of the strongest corner: clamped and free edges by Williams (1952), with
    kappa sin(lambda a)^2 = ((kappa + 1) / 2)^2 - (lambda sin a)^2 at an angle a.
    """
    kinds = (*BODIES, *more)
    return Study(scene, kinds, {SIZE: sizes}, yardstick=ELEMENTS, exponent=exponent)


STUDIES = {
    "cantilever": body("studies/cantilever.toml", (6, 3, 1.5, 0.75), exponent=0.7583),
    "cook": body("studies/cook/cook.toml", (16, 8, 4, 2), exponent=0.6772),
    "lshape": body(
        "lshape/cross.toml",
        (0.5, 0.25, 0.125, 0.0625),
        "nmm_triangles_0_corner",
        "nmm_triangles_1_corner",
        exponent=0.5445,
    ),
    "plate_with_hole": body("plate_with_hole/plate.toml", (1, 0.5, 0.25, 0.125)),
    "edge_crack": body(
        "edge_crack/plate.toml",
        (0.2, 0.1, 0.05, 0.025),
        "nmm_triangles_0_tip",
        "nmm_triangles_1_tip",
        exponent=0.5,
    ),
    "cantilever_swings": Study(
        "studies/cantilever_swings.toml",
        INTEGRATORS,
        {STEP: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4)},
        {"cover": {"type": "quads", "degree": 1, "size": 6}},
        "monitor:tip:uy",
    ),
    "incline_steps": Study(
        "incline/slide.toml",
        INTEGRATORS,
        {STEP: (0.02, 0.01, 0.005, 0.0025)},
        quantity="monitor:toe:ux",
    ),
    "incline_enforcements": Study(
        "incline/slide.toml",
        ENFORCEMENTS,
        {STEP: (0.08, 0.04, 0.02)},
        quantity="monitor:toe:ux",
    ),
    "incline_overlap": Study(
        "incline/slide.toml",
        ENFORCEMENTS,
        {"formulation.contact.normal_penalty": (1, 10, 100)},
        {"integrator": {"step": 0.05}},
        "largest_penetration",
        zero="bodies do not overlap (m)",
    ),
    "arch": Study(
        "arch/shaken.toml",
        ENFORCEMENTS,
        {"formulation.loading.tolerance": (0.1, 0.02, 0.004)},
        {"loading": {"increment": 0.1}},
        "failure_factor",
    ),
}


def measured(
    name: str,
    out: Path,
    repeats: int = 3,
    memory: bool = True,
    vary: Mapping[str, Sequence[Any]] | None = None,
) -> list[Path]:
    """Measure one study and write its page into a folder; ``vary`` replaces its values."""
    import nmm
    from nmm.study.cost import cost_study, yardsticks
    from nmm.study.cost_report import write_cost_report
    from nmm.study.reference import Reference
    from nmm.study.variants import read_formulations

    plan = STUDIES[name]
    files = [HERE / "formulations" / f"{one}.toml" for one in plan.formulations]
    kinds = {
        title: nmm.Formulation.model_validate(one.model_dump(exclude_unset=True) | plan.common)
        for title, one in read_formulations(files).items()
    } | yardsticks(plan.yardstick)
    scene = nmm.read_scene(HERE.parent / plan.scene)
    values = plan.vary if vary is None else vary
    reference = Reference(plan.quantity, 0.0, 0.0, plan.zero) if plan.zero else None
    study = cost_study(
        scene, kinds, values, plan.quantity, repeats, None, memory, plan.exponent, reference
    )
    return write_cost_report(study, out)


def seeds(out: Path, cases: int | None = None) -> list[Path]:
    """Break the beam over its tessellations."""
    from nmm.study.plan import read_plan
    from nmm.study.sweep import run_study
    from nmm.study.sweep_report import write_sweep

    plan, found = read_plan(HERE / "kitoh_seeds/study.toml")
    return write_sweep(run_study(plan, found[:cases], out, processes=1), out)


def main(out: str = "runs/accuracy_cost", *names: str) -> list[Path]:
    """Write the studies named, or all, into a folder."""
    files = []
    for name in names or (*STUDIES, "kitoh_seeds"):
        folder = Path(out) / name
        files += seeds(folder) if name == "kitoh_seeds" else measured(name, folder)
    return files


if __name__ == "__main__":
    print(*main(*sys.argv[1:]), sep="\n")
