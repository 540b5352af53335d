"""Keys that few scenes have, each added to random scenes that are otherwise whole."""
