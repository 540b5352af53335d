"""Mathematical covers: patches and their weights, a file for each type.

Nothing here is cut by material.
"""
