"""Cracks: stress intensity, corners."""
