"""Records of benchmarks: a row each line, with where and when it was measured."""

import argparse
import fcntl
import json
import os
import platform
import subprocess
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
import scipy

import nmm

RECORDS = Path(__file__).parents[1] / "docs" / "enforcements"
CODE = ("nmm", "covers", "integration")


@dataclass(frozen=True, kw_only=True)
class Row:
    """What every row says of its measurement.

    Attributes
    ----------
    date
        When it ended.
    commit
        Last commit of what was measured, with "+" where files had changed since; "" outside git.
    load
        Mean number of processes that ran on the machine, this one among them; 0 when not known.
    budget
        Processor seconds it was allowed; 0 for no limit.
    used
        Processor seconds it took, preparation among them.
    versions
        Of Python and libraries.
    """

    date: str = ""
    commit: str = ""
    load: float = 0.0
    budget: float = 0.0
    used: float = 0.0
    versions: str = ""

    @property
    def key(self) -> tuple[Any, ...]:
        """What no other row of the record has."""
        raise NotImplementedError


def stamp(load_before: float = 0.0) -> dict[str, Any]:
    """Date, commit, load and versions of a row that ends now."""
    return {
        "date": datetime.now().strftime("%Y-%m-%d %H:%M"),
        "commit": commit(),
        "load": round((load_before + load()) / 2 if load_before else load(), 2),
        "versions": (
            f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}, "
            f"scipy {scipy.__version__}"
        ),
    }


def load() -> float:
    """Processes that ran on the machine, mean of the last minute."""
    return os.getloadavg()[0]


def commit() -> str:
    """Last commit of the packages, with "+" where they have changed since; "" outside git."""
    try:
        known = _git("log", "-1", "--format=%h", "--", *CODE)
        return known + ("+" if _git("status", "--porcelain", "--", *CODE) else "")
    except (OSError, subprocess.CalledProcessError):
        return ""


def _git(*words: str) -> str:
    where = Path(nmm.__file__).parents[1]
    done = subprocess.run(["git", *words], cwd=where, check=True, capture_output=True, text=True)
    return done.stdout.strip()


def read(path: Path, kind: type) -> list:
    """Rows of a record; none where there is no record."""
    lines = path.read_text().splitlines() if path.exists() else []
    return [kind(**json.loads(line)) for line in lines]


def keep(path: Path, row: Row) -> None:
    """Put a row into a record, in the place of the one with its key.

    Two processes may write to one record.
    """
    path.parent.mkdir(exist_ok=True)
    gate = os.open(path.parent, os.O_RDONLY)
    try:
        fcntl.flock(gate, fcntl.LOCK_EX)
        known = {one.key: one for one in read(path, type(row))} | {row.key: row}
        fresh = path.with_suffix(".new")
        fresh.write_text("".join(json.dumps(asdict(one)) + "\n" for one in known.values()))
        fresh.replace(path)
    finally:
        os.close(gate)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what says whether rows are kept, and which need not be measured again."""
    parser.add_argument("--page", action="store_true", help="keep rows, write docs/enforcements.md")
    parser.add_argument(
        "--resume",
        nargs="?",
        const="same",
        choices=("same", "any"),
        help="with --page: pass over rows measured at the same commit of the code, or at any",
    )


def write_page() -> None:
    """Write docs/enforcements.md from all records."""
    from enforcement_page import write  # it reads the rows of those that import this

    write(RECORDS)


def standing(row: Row, mode: str | None, budget: float, ran: bool) -> bool:
    """Whether a row of the record may stand instead of a measurement.

    Parameters
    ----------
    row
        The row.
    mode
        None: none may; "same": one of the present commit; "any": one of any.
    budget
        Of the measurement; a row that had less and did not end is measured again.
    ran
        Whether the row was measured to its end.
    """
    if mode is None or (not ran and budget > row.budget):
        return False
    return mode == "any" or row.commit == commit()
