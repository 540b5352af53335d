"""Tables of a formulation: covers, imposition of edge conditions, steps."""
