"""What must hold of rings, blocks, places, supports and amounts before a scene is built."""
