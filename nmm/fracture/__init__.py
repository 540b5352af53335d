"""Cracks: stress intensity, corners, toughness, criteria of growth."""
