"""Tables of crack growth, nucleation and cohesive zones."""
