"""The command line: one file a family of verbs, thin; what they need they import when called."""

from nmm.cli.app import app

__all__ = ["app"]
