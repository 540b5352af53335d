"""Damping of the motion of matter and at its boundaries. Dashpots are in `members`."""
