"""Mathematical covers, physical covers, local functions: what approximates, not what it means.

Imports `integration`; knows no mechanics.
"""
