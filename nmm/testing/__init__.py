"""What parts are held to: oracles and property suites, for built-in parts and those of one's own.

Oracles share nothing with what they judge; every kind of exchangeable part has a suite of one line,
which raises an `AssertionError` that names the property, the number found and the tolerance.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from nmm.testing.block_covers import check_block_cover as check_block_cover
    from nmm.testing.controls import check_control as check_control
    from nmm.testing.covers import check_cover as check_cover
    from nmm.testing.effects.moved import check_moved_effect as check_moved_effect
    from nmm.testing.effects.promises import check_effect as check_effect
    from nmm.testing.effects.promises import check_effect_of as check_effect_of
    from nmm.testing.enforcements import check_enforcement as check_enforcement
    from nmm.testing.enforcements import check_smooth_enforcement as check_smooth_enforcement
    from nmm.testing.impositions import check_imposition as check_imposition
    from nmm.testing.integrators import check_integrator as check_integrator
    from nmm.testing.laws.bonds import check_bond_law as check_bond_law
    from nmm.testing.laws.criteria import check_criterion as check_criterion
    from nmm.testing.laws.interfaces import check_interface_law as check_interface_law
    from nmm.testing.laws.materials import check_law as check_law
    from nmm.testing.laws.strengths import check_strength as check_strength
    from nmm.testing.local_functions import check_local_functions as check_local_functions
    from nmm.testing.outputs import check_output as check_output
    from nmm.testing.solvers import check_solver as check_solver

_HOME = {
    "check_block_cover": "block_covers",
    "check_bond_law": "laws.bonds",
    "check_control": "controls",
    "check_cover": "covers",
    "check_criterion": "laws.criteria",
    "check_effect": "effects.promises",
    "check_effect_of": "effects.promises",
    "check_enforcement": "enforcements",
    "check_imposition": "impositions",
    "check_integrator": "integrators",
    "check_interface_law": "laws.interfaces",
    "check_law": "laws.materials",
    "check_local_functions": "local_functions",
    "check_moved_effect": "effects.moved",
    "check_output": "outputs",
    "check_smooth_enforcement": "enforcements",
    "check_solver": "solvers",
    "check_strength": "laws.strengths",
}

__all__ = list(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'nmm.testing' has no attribute {name!r}")
    return getattr(import_module(f"nmm.testing.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
