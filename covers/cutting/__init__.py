"""Cutting of a cover by material and cracks: elements, physical covers, boundary and crack tips.

Local functions are not its concern.
"""
