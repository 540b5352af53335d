"""Patches and their weights: every mathematical cover, one file each.

Nothing here is cut by material.
"""
