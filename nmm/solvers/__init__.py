"""Linear solvers behind one interface, and the choice among them.

Contact is solved in `contact`, nonlinear matter in `stepping.step`.
"""
