"""Returns of stresses to yield surfaces, all points at once. No laws."""
