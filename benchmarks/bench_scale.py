"""10 000 blocks over tens of steps, each run in a process of its own for its peak of memory."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

SCRIPT = Path(__file__).with_name("scale.py")


@pytest.mark.parametrize(("scene", "steps"), [("wall", 30), ("pile", 10)])
def test_ten_thousand_blocks(benchmark: Any, scene: str, steps: int) -> None:
    benchmark.group = "10000 blocks"
    command = [sys.executable, str(SCRIPT), scene, "10000", str(steps)]
    found = benchmark.pedantic(
        subprocess.run, (command,), {"capture_output": True, "check": True, "text": True}, rounds=1
    )
    benchmark.extra_info |= json.loads(found.stdout)
