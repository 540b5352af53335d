"""What the contact solution keeps from step to step."""

from dataclasses import dataclass


@dataclass
class Memory:
    """Patterns and factors of the last step; owned by the step loop, filled by enforcements.

    One memory belongs to one run: its contents are used only where the problem handed in still
    has the same contacts, and are replaced otherwise.
    """
