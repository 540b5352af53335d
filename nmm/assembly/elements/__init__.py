"""Integrals over elements and their sums: matrices, loads, mass, strain. No constitutive laws."""
