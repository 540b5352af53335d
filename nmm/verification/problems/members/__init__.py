"""Bars with bond, bolts and reinforced beams."""
