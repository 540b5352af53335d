"""Stress-strain laws of the solid.

Laws of joints are in `interfaces`; quadrature points are in `assembly`.
"""
