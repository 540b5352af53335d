"""What a physical cover multiplies its weight by.

Polynomials, and the singular functions of tips and corners.
"""
