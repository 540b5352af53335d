"""The benchmark problems, by subject."""
