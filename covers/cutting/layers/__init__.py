"""One layer of regions: what cuts it, and the elements between these lines."""
