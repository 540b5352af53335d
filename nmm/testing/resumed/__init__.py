"""Runs that are stopped or killed at any moment and gone on with, held to the run that was not."""
