"""Weights times local functions on a cut cover: the manifold and its unknowns.

Rows and element groups evaluate it; ghost penalties and local coordinates keep it well conditioned.
Nothing here decides what is cut.
"""
