"""Temperature of a scene: its equations, the effect, and the strain that it makes."""
