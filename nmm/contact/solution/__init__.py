"""The contact problem of one step: set up, solved, repeated until the interface laws agree.

How one problem is solved is in `enforcement`; which contacts there are, in `points`.
"""
