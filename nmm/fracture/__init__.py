"""Cracks: stress intensity factors, corners, toughness, criteria of growth, nucleation."""
