"""Run folders, frames, summaries and ParaView files."""

from nmm.results.frame import Frame, Topology
from nmm.results.sink import MemorySink, RunData, Sink
from nmm.results.storage.run_folder import RunFolder
from nmm.results.storage.stored_run import StoredRun, read_run
from nmm.results.summary import Summary

__all__ = [
    "Frame",
    "MemorySink",
    "RunData",
    "RunFolder",
    "Sink",
    "StoredRun",
    "Summary",
    "Topology",
    "read_run",
]
