"""Crack nucleation: candidate places, stress along lines from them, and the criteria."""
