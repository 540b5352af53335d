"""Cracks: stress intensity factors, corners, toughness, criteria of growth, nucleation.

Cuts by new segments are in `covers.cutting`; bonds that break are contacts.
"""
