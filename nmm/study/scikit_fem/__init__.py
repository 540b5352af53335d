"""Finite elements of scikit-fem on meshes that fit.

What the cost of the manifold is measured against.
"""
