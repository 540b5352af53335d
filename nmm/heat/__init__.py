"""Heat conduction in a scene, and thermal strain. How fields diffuse is in `diffusion`."""
