"""Finite strain (total Lagrangian): laws of the displacement gradient at material points."""
