"""Running one case of a study, wherever the process is and whatever carries the case."""

import subprocess
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from nmm.shipped import PACKAGE
from nmm.study.cases.quantities import Measured
from nmm.trust import allowing

if TYPE_CHECKING:
    from nmm.study.cases.variants import StudyCase

SKFEM = "skfem"
"""Cover type of a formulation that asks for the finite elements of a yardstick."""


def run_case(case: "StudyCase") -> Measured:
    """Run a case in this process.

    Parts of one's own that are allowed are imported from the folder of the scene file too, behind
    all that is installed.
    """
    with allowing(*case.allow_code, folder=case.folder if case.allow_code else None):
        return _run_allowed(case)


def _run_allowed(case: "StudyCase") -> Measured:
    if case.formulation.cover.type == SKFEM:
        from nmm.study.scikit_fem.yardstick import run_elements

        return run_elements(case.scene, case.formulation)
    from nmm.stepping.run import run

    return run(case.scene, case.formulation)


@cache
def commit() -> str:
    """Return the git commit of this program when it runs from a checkout, else nothing.

    "+ changes" follows where files of the program differ from the commit.
    """
    root = PACKAGE.parent
    if not (root / ".git").exists():
        return ""
    try:
        head = _git(root, "rev-parse", "HEAD")
        changed = _git(root, "status", "--porcelain", "-uno", "--", "nmm", "covers", "integration")
    except (OSError, subprocess.SubprocessError):
        return ""
    return f"{head} + changes" if changed else head


def _git(root: Path, *words: str) -> str:
    done = subprocess.run(
        ["git", *words], cwd=root, capture_output=True, text=True, check=True, timeout=20
    )
    return done.stdout.strip()
