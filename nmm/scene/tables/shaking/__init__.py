"""Tables of what shakes the ground, what lets waves out, and what damps motion."""
