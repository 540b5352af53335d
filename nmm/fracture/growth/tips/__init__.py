"""What crack tips have in a state: intensities, stress along the crack, which feel the load."""
