"""The narrow phase in compiled code: which near vertices and edges are contacts. No search.

Numba keeps what it has compiled until the file of a function changes, whatever that calls: after
an edit in one of these files those that import it have to be touched.
"""
