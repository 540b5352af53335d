"""From manifold elements to sparse matrices and force vectors.

Constitutive laws are in `materials`, solvers in `solvers`; no step is taken here.
"""
