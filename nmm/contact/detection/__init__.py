"""Which vertices and edges meet, cross or share a joint, from the polygons alone.

No rows, no forces.
"""
