"""A linear step: its equations, how they are assembled, and their solution without contact.

Contact is added in `contact`, and internal forces that are not linear in `nonlinear`.
"""
