"""Work within a budget of processor seconds, in a process of its own."""

import signal
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context
from time import process_time
from typing import Any

TICK = 1.0
"""Seconds between looks at the clock."""


class Overtime(BaseException):
    """The budget is spent; no `Exception`, so that nothing measured takes it for its own."""


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Raise `Overtime` in what runs longer than a number of processor seconds.

    It comes at the next return to Python: a factorisation is not broken off.
    """
    end = process_time() + seconds

    def look(*_: Any) -> None:
        if process_time() > end:
            raise Overtime

    # A timer of processor seconds would make the kernel count those of the process in ticks of
    # 4 ms as long as it is set. Raised at every look, should a callback have lost the first.
    before = signal.signal(signal.SIGALRM, look)
    signal.setitimer(signal.ITIMER_REAL, min(TICK, seconds), min(TICK, seconds))
    try:
        yield
    except SystemError:
        # compiled code that was called when `Overtime` was raised tells it so
        if process_time() > end:
            raise Overtime from None
        raise
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def apart(work: Callable[..., Any], *args: Any) -> tuple[Any, str]:
    """Return what a call gives in a process of its own, or None and what ended it.

    So its memory is its own, and what goes wrong costs a row, not the page.
    """
    with ProcessPoolExecutor(1, mp_context=get_context("fork")) as pool:
        try:
            return pool.submit(work, *args).result(), ""
        except BrokenProcessPool:
            return None, "the system ended the process, as it does when memory is spent"
        except Exception as fault:
            return None, f"ended by {type(fault).__name__}: {fault}"
