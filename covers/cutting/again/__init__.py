"""A cut by cracks that have grown: cells about their new pieces are cut, all else is kept."""
