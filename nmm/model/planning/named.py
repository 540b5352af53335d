"""Built-in effects of a scene that the step loop knows by name."""

from typing import TYPE_CHECKING

from nmm.frozen import MadeOnce
from nmm.model.planning.hooks import Hooks

if TYPE_CHECKING:
    from nmm.constraints.supports import Supports
    from nmm.effects.contact import Contact
    from nmm.effects.inertia import Inertia
    from nmm.effects.initial.initial_stress import InitialStress
    from nmm.effects.loading.loads import Loads
    from nmm.fracture.growth.growing import GrowingCracks
    from nmm.splitting.splitting import Splitting


class NamedEffects(Hooks):
    """Effects by name and hook, some of them as attributes; None where the scene has none."""

    @MadeOnce
    def contact(self) -> "Contact | None":
        """The contact effect."""
        return self.effects.get("contact")  # type: ignore[return-value]

    @MadeOnce
    def fracture(self) -> "GrowingCracks | None":
        """The growth of cracks."""
        return self.effects.get("fracture")  # type: ignore[return-value]

    @MadeOnce
    def inertia(self) -> "Inertia | None":
        """The inertia effect."""
        return self.effects.get("inertia")  # type: ignore[return-value]

    @MadeOnce
    def loads(self) -> "Loads | None":
        """The point and edge loads."""
        return self.effects.get("loads")  # type: ignore[return-value]

    def scaled_load(self, factor: float) -> float | None:
        """Return the resultant (N) of the scaled loads at a load factor; None without loads."""
        return None if self.loads is None else self.loads.scaled_resultant(factor)

    @MadeOnce
    def splitting(self) -> "Splitting | None":
        """The blocks that may split."""
        return self.effects.get("splitting")  # type: ignore[return-value]

    @MadeOnce
    def supports(self) -> "Supports | None":
        """The supports."""
        return self.effects.get("supports")  # type: ignore[return-value]

    @MadeOnce
    def initial_stress(self) -> "InitialStress | None":
        """The initial stress."""
        return self.effects.get("initial stress")  # type: ignore[return-value]
