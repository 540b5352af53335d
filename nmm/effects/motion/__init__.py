"""Motion of the ground: records, boundaries that waves leave through, the free field.

Integration in time is in `integrators`.
"""
