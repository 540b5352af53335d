"""Blocks that split where nobody laid a joint: strength, planes and cuts (Lin 1995).

Their state is carried over in `assembly.carried`.
"""
