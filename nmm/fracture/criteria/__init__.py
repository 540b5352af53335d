"""Mixed-mode criteria: the kink angle of a crack, and its equivalent stress intensity factor.

Intensities are in `growth.tips`.
"""
