"""Tractions across the edges that bodies share: of either side, averaged, and how large.

Tractions of contacts are in `contact`.
"""
