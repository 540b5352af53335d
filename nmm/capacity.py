"""How much memory a run may ask for: estimated and told before it is taken.

The limit is the memory of the machine. It is raised, or lowered, by the environment variable
`NMM_MEMORY` ("16 GB") or by `limited`; nothing in a scene can move it.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path

from nmm.errors import Fault, NmmError

VARIABLE = "NMM_MEMORY"
GIGABYTE = 1e9
# Where nothing is known of the machine.
USUAL = 8 * GIGABYTE
# Bytes, measured over whole runs and rounded up: of a block with its contacts (100 000 touching
# blocks take 7 GB), of a cell of a net with its share of matrices and factors, of a step's numbers.
BLOCK, CELL, STEP = 7e4, 1.2e4, 1e3

_LIMIT: ContextVar[float | None] = ContextVar("memory", default=None)


@contextmanager
def limited(amount: float) -> Iterator[None]:
    """Let runs within a ``with`` block take ``amount`` bytes."""
    token = _LIMIT.set(amount)
    try:
        yield
    finally:
        _LIMIT.reset(token)


def limit() -> float:
    """Return how many bytes a run may take.

    Raises
    ------
    NmmError
        When `NMM_MEMORY` is no amount.
    """
    given = _LIMIT.get()
    if given is not None:
        return given
    text = os.environ.get(VARIABLE, "").strip()
    if not text:
        return _of_machine()
    number = text.removesuffix("GB").strip()
    try:
        found = float(number) * GIGABYTE
    except ValueError:
        found = -1.0
    if not 0 < found < float("inf"):
        raise NmmError(Fault(VARIABLE, repr(text), "gigabytes", f'write {VARIABLE}="16 GB"'))
    return found


def refuse(place: str, what: str, amount: float, remedy: str) -> None:
    """Refuse what would take more memory than there is.

    Parameters
    ----------
    place, what, remedy
        Of the line that is told.
    amount
        Estimated bytes.

    Raises
    ------
    NmmError
        When ``amount`` is above the limit.
    """
    most = limit()
    if amount > most:
        value = f"{what}, about {amount / GIGABYTE:.3g} GB of memory"
        raise NmmError(
            Fault(
                place,
                value,
                f"at most {most / GIGABYTE:.3g} GB",
                f'{remedy}, or allow more: {VARIABLE}="{1.1 * amount / GIGABYTE:.3g} GB"',
            )
        )


def _of_machine() -> float:
    """Return the bytes of memory of the machine, or of the container this runs in."""
    amounts = [USUAL]
    if hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
        amounts = [float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))]
    with suppress(OSError, ValueError):  # no container, or one without a limit
        amounts.append(float(Path("/sys/fs/cgroup/memory.max").read_text()))
    return min(amounts)
