"""Hard cases run, kept in records, reduced to what still fails, and shown on a page."""
