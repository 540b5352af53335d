"""Benchmark problems with reference answers that were found without this program.

Scenes without a reference, held to invariances, are in `hard`.
"""

from nmm.verification.base import Case, Check, SceneCase
from nmm.verification.outcomes import Outcome, judge, runs, verify
from nmm.verification.registry import CASES

__all__ = ["CASES", "Case", "Check", "Outcome", "SceneCase", "judge", "runs", "verify"]
