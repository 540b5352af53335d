"""Fields that are conserved: what is taken up is stored."""

from nmm.effects.base import defines
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent


def fields(run: EndedRun) -> Findings:
    """Audit the balance of heat and of water."""
    lacking = {
        name: effect.imbalance(run.state)
        for name, effect in run.stepper.plan.effects.items()
        if defines(effect, "imbalance")
    }
    if lacking:
        name = max(lacking, key=lambda one: lacking[one])
        yield AuditFinding(
            "field_imbalance",
            lacking[name],
            f"{name}: {percent(lacking[name])} of what came and went is neither stored nor gone",
            "the linear system was not solved: bring conductivities nearer to each other",
        )
