"""Linear solvers behind one interface, and the choice among them."""
