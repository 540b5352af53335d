"""Write the report on what accuracy costs anew: Cook's membrane and the beam over 12 seeds.

Takes about two minutes of one processor. Records are measured in one session; run it on a machine
that does nothing else, and read the ratio of wall to processor seconds that the page states.
"""

import sys
from pathlib import Path

from nmm.study.threads import one_thread

one_thread()  # before numpy is imported

HERE = Path(__file__).resolve().parent
COOK = ("dda_1", "dda_2", "dda_3", "nmm_triangles_0", "nmm_triangles_1", "nmm_triangles_2")
COOK += ("nmm_quads_0", "nmm_quads_1", "nmm_quads_2", "mls")


def cook(
    out: Path, sizes: tuple[float, ...] = (16, 8, 4, 2), repeats: int = 3, memory: bool = True
) -> list[Path]:
    """Measure the membrane under every formulation."""
    import nmm
    from nmm.study.cost import cost_study
    from nmm.study.cost_report import write_cost_report
    from nmm.study.variants import SIZE, read_formulations

    scene = nmm.read_scene(HERE / "cook/cook.toml")
    kinds = read_formulations([HERE / f"cook/{name}.toml" for name in COOK])
    study = cost_study(scene, kinds, {SIZE: sizes}, repeats=repeats, memory=memory)
    return write_cost_report(study, out)


def seeds(out: Path, cases: int | None = None) -> list[Path]:
    """Break the beam over its tessellations."""
    from nmm.study.plan import read_plan
    from nmm.study.sweep import run_study
    from nmm.study.sweep_report import write_sweep

    plan, found = read_plan(HERE / "kitoh_seeds/study.toml")
    return write_sweep(run_study(plan, found[:cases], out, processes=1), out)


def main(out: str = "runs/accuracy_cost") -> list[Path]:
    """Write both into a folder."""
    return [*cook(Path(out) / "cook"), *seeds(Path(out) / "kitoh_seeds")]


if __name__ == "__main__":
    print(*main(*sys.argv[1:]), sep="\n")
