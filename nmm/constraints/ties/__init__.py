"""Permanent ties between bodies: glued blocks, sub-blocks, joints that never part.

How a tie is held is an imposition, as that of supports (`constraints.imposition`).
"""
