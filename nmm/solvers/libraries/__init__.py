"""Decompositions by libraries: SuperLU of scipy, and QDLDL and MUMPS where they are installed."""
