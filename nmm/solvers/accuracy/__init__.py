"""How accurate a solution is, and its refinement: significant loads, residuals, rounding errors.

Decompositions are in `frontal` and `libraries`.
"""
