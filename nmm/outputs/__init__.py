"""Quantities that a scene's ``[output] quantities`` asks for, one file a family.

They are read from an accepted state and never change a run.
"""
