"""Quantities that effects and outputs declare, gathered and checked for frames and history."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.errors import NmmError
from nmm.model.effects_table import OWN
from nmm.model.planning.plan import Plan
from nmm.outputs.base import OUTPUTS, Output, View
from nmm.quantity import APART, PLACES, Quantity


@dataclass(frozen=True)
class DeclaredOutputs:
    """The outputs that a scene names, by their names there."""

    outputs: Mapping[str, Output] = field(default_factory=dict)

    @classmethod
    def of(cls, names: Iterable[str]) -> Self:
        """Return the outputs that are named."""
        return cls({name: OUTPUTS.make(name) for name in names})

    def fields(self, plan: Plan, view: View) -> dict[str, Quantity]:
        """Return all quantities of a state by name; those of effects after the effect's.

        Raises
        ------
        NmmError
            When one does not fit what it is said to belong to, or two have one name.
        """
        found: dict[str, Quantity] = {}
        for who, name, one in self._fields(plan, view):
            if name in found:
                raise NmmError(
                    f"{who}: quantity {name}: expected a name of its own, another output has it: "
                    "rename it"
                )
            found[name] = _on_elements(view.model, _checked(who, name, one, view))
        members = plan.segments(view.state)
        return found if members is None else found | members.quantities

    def _fields(self, plan: Plan, view: View) -> Iterator[tuple[str, str, Quantity]]:
        for name, effect in plan.named("outputs"):
            for key, one in effect.outputs(view.state).items():
                yield name, f"{name.removeprefix(OWN)}:{key}", one
        for name, output in self.outputs.items():
            for key, one in output.fields(view).items():
                yield name, key, one

    def row(self, plan: Plan, view: Callable[[], View]) -> dict[str, float]:
        """Return the numbers of a state by their columns of the history."""
        row: dict[str, float] = {}
        for name, effect in plan.tellers:
            own = name.removeprefix(OWN)
            row |= {f"{own}:{key}": float(n) for key, n in effect.history(view().state).items()}
        seen = [one for one in self.outputs.values() if type(one).history is not Output.history]
        for output in seen:
            row |= {key: float(number) for key, number in output.history(view()).items()}
        return row


def _checked(who: str, name: str, one: Quantity, view: View) -> Quantity:
    manifold, contacts = view.model.manifold, view.contacts
    counts: dict[str, int] = {
        "points": len(manifold.elements.points),
        "elements": len(manifold.elements),
        "bodies": manifold.n_bodies,
        "contacts": 0 if contacts is None else len(contacts),
        "members": 0,  # those of effects alone
        **dict.fromkeys(APART[1:], len(one.values)),
    }
    if one.on not in counts:
        raise NmmError(
            f"{who}: quantity {name}: on {one.on!r}: expected one of {', '.join(PLACES)}: correct "
            "what it belongs to"
        )
    values: Floats = np.asarray(one.values, dtype=float)
    width = values.shape[1] if values.ndim == 2 else 1
    names = len(one.components)
    if values.ndim not in (1, 2) or len(values) != counts[one.on] or (names and names != width):
        raise NmmError(
            f"{who}: quantity {name}: values of shape {values.shape}, {names} components: expected "
            f"{counts[one.on]} rows, one for each of the {one.on}, and as many names of components "
            "as columns: correct the values"
        )
    return one if values is one.values else replace(one, values=values)


def _on_elements(model: Model, one: Quantity) -> Quantity:
    """Return a quantity of bodies as one of their elements."""
    if one.on != "bodies":
        return one
    return replace(one, on="elements", values=one.values[model.manifold.element_body])
