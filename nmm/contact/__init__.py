"""Contact: search, gaps and joints; one file for each enforcement."""
