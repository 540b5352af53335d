"""One layer of regions: the lines that cut it, and the elements between them."""
