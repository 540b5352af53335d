"""Crack growth: fronts and their intensities, the growth rule, new segments, growth in time.

Criteria are in `criteria`.
"""
