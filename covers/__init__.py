"""Mathematical covers, physical covers, local functions: the approximation of displacements.

Imports `integration`; knows no mechanics.
"""
