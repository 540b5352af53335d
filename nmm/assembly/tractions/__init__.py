"""Tractions across shared edges: of either side, their average, and bounds.

Tractions of contacts are in `contact`.
"""
