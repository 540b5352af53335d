"""Patch tests: fields that covers hold must come out exactly."""
