"""How a run, or a study, tells how far it is."""

from collections.abc import Callable

Progress = Callable[[float, str], None]
"""Takes the part that is done, 0 to 1, and what is being done."""
