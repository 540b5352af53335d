"""Exact integrals and point rules on polygons, segments and around crack tips.

No covers, no mechanics.
"""
