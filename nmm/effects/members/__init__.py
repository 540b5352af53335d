"""What connects points: springs, dashpots, bars with bond, foundations; and masses at points.

No supports.
"""
