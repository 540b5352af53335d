"""One case of a study: its variant, its run, its cost, its record."""
