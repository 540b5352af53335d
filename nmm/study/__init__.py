"""Studies: one or many scenes under many formulations; error, seconds, memory, side by side.

Reference answers are in `verification`.
"""
