"""Local functions of physical covers.

Polynomials, and the singular functions of crack tips and corners. Their products with weights are
in `approximation`.
"""
