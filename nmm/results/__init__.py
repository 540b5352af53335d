"""Run folders, frames, summaries and ParaView files.

What they hold is collected in `stepping.reports`; pictures are in `plots`.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nmm.results.frame import Frame as Frame
    from nmm.results.frame import Topology as Topology
    from nmm.results.sink import MemorySink as MemorySink
    from nmm.results.sink import RunData as RunData
    from nmm.results.sink import Sink as Sink
    from nmm.results.storage.run_folder import RunFolder as RunFolder
    from nmm.results.storage.stored_run import StoredRun as StoredRun
    from nmm.results.storage.stored_run import read_run as read_run
    from nmm.results.summary import Summary as Summary

# Looked up on first use: who needs the names of a summary's lines reads no run folder.
_HOME = {
    "Frame": "frame",
    "MemorySink": "sink",
    "RunData": "sink",
    "RunFolder": "storage.run_folder",
    "Sink": "sink",
    "StoredRun": "storage.stored_run",
    "Summary": "summary",
    "Topology": "frame",
    "read_run": "storage.stored_run",
}

__all__ = list(_HOME)


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(f"nmm.results.{_HOME[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
