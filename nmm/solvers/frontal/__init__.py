"""The multifrontal Cholesky and LU solvers in compiled code, with their ordering.

A package of its own behind `LinearSolver`.
"""
