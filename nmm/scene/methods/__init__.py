"""Tables of a formulation: covers, imposition of edge conditions, steps.

How they are carried out is elsewhere.
"""
