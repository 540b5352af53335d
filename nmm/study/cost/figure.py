"""The work-precision figure of a cost study."""

from pathlib import Path
from textwrap import wrap

import numpy as np

from nmm.study.cases.record import finest
from nmm.study.cost.cost_study import CostStudy
from nmm.study.cost.reference import Reference


def draw(study: CostStudy, path: Path) -> None:
    """Draw the work-precision figure."""
    from nmm.plots.work_precision import WorkPrecision, work_precision

    on_front = study.front()
    sizes = {one.unknowns for one in study.records if one.unknowns}
    counted = "unknowns" if len(sizes) > 1 else "steps"
    methods = distinguished(study)
    series = {
        name: WorkPrecision(
            error=study.errors(many),
            seconds=[one.median_seconds for one in many],
            counts=[float(getattr(one, counted) or np.nan) for one in many],
            memory=[float(one.memory or np.nan) for one in many],
            on_front=[one in on_front for one in many],
            valid=[one.valid for one in many],
            phases=finest(many).phases,
            effects=finest(many).by_effect,
            family=many[0].family,
            method=methods[name],
        )
        for name, many in study.by_formulation().items()
    }
    reference = study.reference
    work_precision(
        series,
        title=study.title,
        counted=counted,
        reference=_against(reference),
        error_name=f"{reference.kind_of_error} of {reference.quantity.replace('_', ' ')}",
        uncertainty=study.floor,
        path=path,
    )


def distinguished(study: CostStudy) -> dict[str, str]:
    """Return what tells formulations apart: their cover, else their enforcement or integrator."""
    groups = study.by_formulation()
    for part in ("cover", "enforcement", "integrator"):
        found = {name: many[0].method.get(part, "") for name, many in groups.items()}
        if len(set(found.values())) == len(found):
            return found
    return {name: many[0].method.get("cover", "") for name, many in groups.items()}


def _against(reference: Reference) -> str:
    """Say under the title what errors are taken against."""
    text = f"error against {reference.value:.6g}: {reference.source}"
    if reference.extrapolated:
        text += f", uncertainty {reference.uncertainty:.1g}"
    return "\n".join(wrap(text, 98))
