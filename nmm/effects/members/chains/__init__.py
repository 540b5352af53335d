"""Chains of links with slip between them: how they are joined, and their equilibrium."""
