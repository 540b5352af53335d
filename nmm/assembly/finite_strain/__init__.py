"""Finite strain: bodies that bend by any angle, by the gradient of displacement at their points."""
