"""Bonds that consistent terms hold until they break: no spring stands between the blocks."""
