"""Write the report on what accuracy costs anew: all studies of `docs/accuracy_cost`.

``python examples/studies/report.py docs/accuracy_cost`` takes a quarter of an hour of one
processor; names after the folder choose studies. Records are measured in one session: run it on a
machine that does nothing else, and read the ratio of wall to processor seconds that each page
states.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from nmm.study.cases.threads import one_thread

one_thread()  # before numpy is imported

HERE = Path(__file__).resolve().parent
SIZE = "formulation.cover.size"
BODIES = ("dda", "dda_2", "dda_3", "sub_blocks")
BODIES += ("nmm_triangles_0", "nmm_triangles_1", "nmm_triangles_2")
BODIES += ("nmm_quads_0", "nmm_quads_1", "nmm_quads_2", "mls")
ELEMENTS = ("P1", "P2", "P3")
STEP = "formulation.integrator.step"
INTEGRATORS = ("shi", "newmark", "generalized_alpha")
QUANTITY = "external_work"
LEVELS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
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
    repeats: int = 3
    memory: bool = True


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
        repeats=1,
        memory=False,
    ),
    "incline_overlap": Study(
        "incline/slide.toml",
        ENFORCEMENTS,
        {"formulation.contact.normal_penalty": (1, 10, 100)},
        {"integrator": {"step": 0.05}},
        "largest_penetration",
        zero="bodies do not overlap (m)",
        repeats=1,
        memory=False,
    ),
    "arch": Study(
        "arch/shaken.toml",
        ENFORCEMENTS,
        {"formulation.loading.tolerance": (0.1, 0.01)},
        {"loading": {"increment": 0.1}},
        "failure_factor",
        repeats=1,
        memory=False,
    ),
}


def measured(
    name: str,
    out: Path,
    repeats: int | None = None,
    memory: bool | None = None,
    vary: Mapping[str, Sequence[Any]] | None = None,
) -> list[Path]:
    """Measure one study and write its page into a folder; what is given replaces its values."""
    import nmm
    from nmm.study.cases.variants import read_formulations
    from nmm.study.cost.cost_study import cost_study, yardsticks
    from nmm.study.cost.reference import Reference
    from nmm.study.cost.report import write_cost_report

    plan = STUDIES[name]
    files = [HERE / "formulations" / f"{one}.toml" for one in plan.formulations]
    kinds = {
        title: nmm.Formulation.model_validate(one.model_dump(exclude_unset=True) | plan.common)
        for title, one in read_formulations(files).items()
    } | yardsticks(plan.yardstick)
    scene = nmm.read_scene(HERE.parent / plan.scene)
    values = plan.vary if vary is None else vary
    repeats = plan.repeats if repeats is None else repeats
    memory = plan.memory if memory is None else memory
    reference = Reference(plan.quantity, 0.0, 0.0, plan.zero) if plan.zero else None
    study = cost_study(
        scene, kinds, values, plan.quantity, repeats, None, memory, plan.exponent, reference
    )
    return write_cost_report(study, out)


def summary(out: Path) -> list[Path]:
    """Write one table over all bodies: the cheapest of each family at equal error."""
    import nmm
    from nmm.study.cost.cost_study import read_records
    from nmm.study.cost.front import costs_at_levels
    from nmm.study.cost.reference import by_name, stated_reference

    lines = [
        "# The cheapest of each family",
        "",
        "Processor seconds at equal error in energy, whole run; least of each family. Names with a",
        "sign of at most are better than the error already with their cheapest run. Covers that",
        "touch the tip of a crack carry its functions anyhow; those with singular fields, more.",
        "",
        "| scene | error | DDA | manifold | + singular fields | scikit-fem | manifold over it |",
        "|---|---|---|---|---|---|---|",
    ]
    for name in (one for one in STUDIES if (out / one / "records.jsonl").exists()):
        if not STUDIES[name].yardstick:
            continue
        reference = stated_reference(nmm.read_scene(HERE.parent / STUDIES[name].scene), QUANTITY)
        assert reference is not None
        groups = {
            title: [one for one in many if one.valid]
            for title, many in by_name(read_records(out / name / "records.jsonl")).items()
        }
        points = {
            title: ([one.median_seconds for one in many], [reference.error(one) for one in many])
            for title, many in groups.items()
            if many
        }
        for level, at in costs_at_levels(points, LEVELS).items():
            best: dict[str, str] = {}
            for title in sorted(at, key=lambda one: at[one].value):
                enriched = "enriched" in groups[title][0].method["cover"]
                best.setdefault("fields" if enriched else groups[title][0].family, title)
            cells = [
                f"{best[one]} {at[best[one]]} s" if one in best else ""
                for one in ("DDA", "manifold", "fields", "elements")
            ]
            both = "manifold" in best and "elements" in best
            ratio = at[best["manifold"]].value / at[best["elements"]].value if both else None
            over = f"{ratio:.2g}" if ratio else ""
            if best:
                lines.append(f"| {name} | {level:g} | {' | '.join(cells)} | {over} |")
    path = out / "summary.md"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return [path]


def seeds(out: Path, cases: int | None = None) -> list[Path]:
    """Break the beam over its tessellations."""
    from nmm.study.sweep.report import write_sweep
    from nmm.study.sweep.runs import run_study
    from nmm.study.sweep.study_file import read_plan

    plan, found = read_plan(HERE / "kitoh_seeds/study.toml")
    return write_sweep(run_study(plan, found[:cases], out, processes=1), out)


def main(out: str = "runs/accuracy_cost", *names: str) -> list[Path]:
    """Write the studies named, or all, into a folder."""
    files = []
    for name in names or (*STUDIES, "kitoh_seeds"):
        folder = Path(out) / name
        files += seeds(folder) if name == "kitoh_seeds" else measured(name, folder)
    return [*files, *summary(Path(out))]


if __name__ == "__main__":
    if {"-h", "--help"} & set(sys.argv):
        sys.exit(__doc__)
    print(*main(*sys.argv[1:]), sep="\n")
