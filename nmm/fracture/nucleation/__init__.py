"""Crack nucleation: candidate places, stress along lines from them, and the criteria.

Growth of what has nucleated is in `growth`.
"""
