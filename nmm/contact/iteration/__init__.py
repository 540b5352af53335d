"""The iterative methods for the contact problem of a step.

Interior point (`interior`), rounds of multipliers, Newton's method (`newton`), and which goes
first. They know springs and limits, no geometry and no interface law.
"""
