"""Time integrators, one file each. They know vectors and a step, no contact and no model."""
