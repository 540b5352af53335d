"""The factor of safety: strengths are divided until nothing holds.

Bounds of it without steps are in `bounds`.
"""
