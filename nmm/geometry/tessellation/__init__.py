"""Regions divided: Voronoi cells, joint sets, sub-blocks.

With what repairs their scraps and short edges.
"""
