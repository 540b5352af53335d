"""Random small scenes over every table: bodies, matter, what acts, how it is approximated."""
