"""The iterative methods for the contact problem of a step.

Interior point, rounds of multipliers, and Newton's method (`newton`). They know springs
and limits, no geometry and no interface law.
"""
