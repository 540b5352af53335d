"""The Kitoh beam to its failure load, 130 and 455 blocks."""

from pathlib import Path
from typing import Any

import pytest

import nmm

SCENES = Path(__file__).parents[1] / "examples" / "kitoh_beam"


def failure(blocks: int) -> nmm.Run:
    """Run one beam to its failure load."""
    return nmm.run(nmm.read_scene(SCENES / f"kitoh_{blocks}.toml"))


@pytest.mark.parametrize("blocks", [130, 455])
def test_kitoh_beam_to_failure(benchmark: Any, blocks: int) -> None:
    benchmark.group = "Kitoh beam to failure"
    found = benchmark.pedantic(failure, (blocks,), rounds=1, warmup_rounds=int(blocks == 130))
    one = found.summary
    benchmark.extra_info |= {
        "blocks": blocks,
        "unknowns": one.unknowns,
        "failure (kN)": (one.failure_load or 0.0) / 1e3,
        "steps": one.steps,
        "passes": one.passes,
    }
