"""Weights times local functions on a cut cover: the manifold and its unknowns.

Rows and element groups evaluate it; ghost terms and deflation keep its functions independent.
Nothing here decides what is cut.
"""
