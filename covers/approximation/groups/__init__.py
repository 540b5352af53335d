"""Element groups: values, gradients and integrals of elements of the same local functions.

Unknowns are numbered in `approximation`.
"""
