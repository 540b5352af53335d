"""The contact points of a step: which bodies meet, what search finds, what goes on from before.

How edges meet is in `detection`; what force the points carry is found in `solution`.
"""
