"""Stress-strain laws of the solid."""
