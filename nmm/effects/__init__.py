"""Physical effects, one file each; a scene's effect is imported only when the scene names it."""
