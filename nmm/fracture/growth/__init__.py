"""Growth of cracks: fronts and their intensities, the rule of growth, where new pieces end."""
