"""What is there before anything moves: velocities and stress."""
