"""Loads that are fields, that turn with a surface, and that travel. Dead loads are in `effects`."""
