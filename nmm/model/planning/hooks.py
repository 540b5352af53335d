"""Which effects of a scene have which hook, and the seconds each effect has cost."""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from time import perf_counter
from typing import TypeVar

from nmm.effects.base import Effect, defines

T = TypeVar("T")


@dataclass(frozen=True)
class Hooks:
    """Effects by name and hook; a hook that no effect defines is never called.

    Attributes
    ----------
    effects
        In the order of the table.
    seconds
        Wall-clock seconds by effect.
    hooks
        The effects that have each hook that was asked for, by name.
    """

    effects: dict[str, Effect]
    seconds: dict[str, float] = field(default_factory=partial(defaultdict, float))
    hooks: dict[str, list[tuple[str, Effect]]] = field(default_factory=dict)

    def having(self, hook: str) -> list[Effect]:
        """Return the effects that define a hook."""
        return [effect for _, effect in self.named(hook)]

    def named(self, hook: str) -> list[tuple[str, Effect]]:
        """Return the effects that define a hook, with their names."""
        if hook not in self.hooks:
            named = self.effects.items()
            self.hooks[hook] = [(name, one) for name, one in named if defines(one, hook)]
        return self.hooks[hook]

    def timed(self, name: str, call: Callable[[], T]) -> T:
        """Return what a call returns, its seconds counted for an effect."""
        start = perf_counter()
        result = call()
        self.seconds[name] += perf_counter() - start
        return result
