"""Scalar fields on a manifold: one unknown a function, where displacements have two.

They have the cutting, the local functions and the degree of the displacements; cracks cut both.
"""
