"""Steps along a path: the load factor is found with the unknowns, from one more equation.

Which equation, and how a path is followed, is in `controls` and `stepping.control`.
"""
