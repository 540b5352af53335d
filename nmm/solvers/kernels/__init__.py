"""Compiled functions that serve many: elimination of few equations, sorting, scaling. No solver."""
