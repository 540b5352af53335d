"""One picture of a run a file."""
