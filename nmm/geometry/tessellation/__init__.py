"""Regions divided into blocks: Voronoi cells, joint sets, sub-blocks.

With what repairs their scraps and short edges.
"""
