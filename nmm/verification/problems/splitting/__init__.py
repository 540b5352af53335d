"""Blocks that split: by strength, by impact, by a wedge; the motion of their pieces."""
