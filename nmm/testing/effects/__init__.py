"""What every effect is held to: how its force, matrix, work and energy fit, here or moved."""
