"""Lines as a plane graph: they meet at common ends, and bound faces that are simple polygons."""
