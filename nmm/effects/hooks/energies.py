"""Hooks of the energy balance of effects."""

from nmm.assembly.state import State


class EnergyHooks:
    """Work, stored and dissipated energy of an effect in accepted steps (J)."""

    def work(self, before: State, after: State) -> float:
        """Work (J) that the effect did on the bodies in an accepted step."""
        raise NotImplementedError

    def first_work(self, before: State, after: State) -> float:
        """Work (J) to add to `work` in the first step of statics; called before it.

        Nothing acts before that step: a force that acts at its start grows from zero within it.
        """
        raise NotImplementedError

    def energy(self, state: State) -> float:
        """Energy (J) that the effect stores."""
        raise NotImplementedError

    def loss(self, before: State, after: State) -> float:
        """Energy (J) that the effect dissipated in an accepted step."""
        raise NotImplementedError

    def missed_loss(self, before: State, after: State) -> float:
        """Energy (J) dissipated in a step of statics beyond `loss`, and done by loads beyond means.

        `loss` counts the mean of the forces at both ends, as loads do their work. Where a force is
        no line in between, in equilibrium with the loads, this is the area that both lack.
        """
        raise NotImplementedError

    def imbalance(self, state: State) -> float:
        """Error of the balance of its own conserved quantity, as a share of the turnover."""
        raise NotImplementedError
