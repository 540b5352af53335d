"""What the command line leaves out at its end."""

import subprocess
import sys

ASKED = """
import atexit, gc
last = []  # what is registered first is called last
atexit.register(lambda: print("left", gc.get_freeze_count() > 0.9 * last[0]))
from nmm.cli.app import app
try:
    app(["--version"])
except SystemExit:
    last.append(len(gc.get_objects()))
"""


def test_a_verb_ends_without_a_last_search_through_what_it_imported():
    ended = subprocess.run(
        [sys.executable, "-c", ASKED], capture_output=True, text=True, check=True
    )
    assert ended.stdout.splitlines()[-1] == "left True"
