"""The table of growing cracks, and what it must not contradict."""
