"""Contact averaged over faces: mortar segments, trace space, multiplier basis.

What acts at single corners is in `points`.
"""
