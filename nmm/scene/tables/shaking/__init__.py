"""Tables of ground motion, absorbing boundaries and damping."""
