"""Singular points: covers that carry their functions, branches of the angle, quadrature.

The functions themselves are in `local_functions`.
"""
