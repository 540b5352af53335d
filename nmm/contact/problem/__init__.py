"""The contact problem of one step, free of geometry.

Rows, limits, Coulomb's law, the springs it cuts off, their matrix and residual. How it is solved is
in `iteration`.
"""
