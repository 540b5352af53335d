"""Contact enforcements, one file each, and those that wrap any of them.

Iterations that several share are in `iteration`.
"""
