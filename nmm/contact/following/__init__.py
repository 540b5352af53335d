"""Steps along a path: the load factor is found with the unknowns, from one more equation."""
