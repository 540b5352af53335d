"""Islands of blocks: who touches whom, directly or through others; their parts of a problem.

Blocks that the ground holds pass hardly anything on: what stands on them stands apart.
"""
