"""The state of a model carried over to the next one: places, displacements, rates, history.

Parentage is in `covers.change`.
"""
