"""Tables of a formulation: covers, conditions on edges, steps. What happens is no part of it."""
