"""From interface laws to force limits and springs of contact points.

Within a step, and between two solutions of it. The laws themselves are in `nmm.interfaces`.
"""
