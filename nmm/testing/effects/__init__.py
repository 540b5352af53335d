"""What every effect is held to, and how its force, matrix, work and energy fit each other."""
