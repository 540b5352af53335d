"""Tables of crack growth, nucleation and cohesive zones, and their consistency rules."""
