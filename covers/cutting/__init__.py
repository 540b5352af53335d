"""Geometry of a cut: cover, material and cracks give elements, physical covers, boundary and tips.

No local functions.
"""
