"""Cracks in elastic bodies: intensities, kinks, growth, nucleation. For zones see `cohesive`."""
