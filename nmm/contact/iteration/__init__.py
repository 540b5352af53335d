"""The iterative methods for the contact problem of a step.

Semismooth and modified Newton, open-close, interior point, rounds of multipliers. They know springs
and limits, no geometry and no interface law.
"""
