"""Contact points: places on the material, rows of unknowns, reference gaps, tracking.

Which of them exist is found in `detection`; what force they carry is found in `iteration`.
"""
