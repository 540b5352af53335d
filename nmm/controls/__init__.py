"""What grows in a static run in place of the load: a displacement, an opening, energy.

How a path is followed is in `stepping.control`.
"""
