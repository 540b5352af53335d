"""Blocks that split where there is no joint: strength, planes and cuts (Lin 1995).

Their state is carried over in `assembly.transfer`.
"""
