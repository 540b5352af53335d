"""Heat conduction in a scene, and thermal strain."""
