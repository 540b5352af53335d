"""Meshless covers: discs about nodes, with weights of weighted fits."""
