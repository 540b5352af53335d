"""What must hold whatever the scene: no answer is known, and none is needed."""
