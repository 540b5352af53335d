"""Steps whose internal forces are not linear: iterates, forces of matter and effects, Newton."""
