"""Contact of one step: posed, solved, asked of the laws again.

How one problem is solved is in `enforcement`; which contacts there are, in `points`.
"""
