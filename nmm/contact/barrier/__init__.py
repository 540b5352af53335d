"""The barrier's own potential and its Newton and path-following methods.

The enforcement is in `enforcement`.
"""
