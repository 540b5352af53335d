"""The local update of a cut after crack growth: only cells about new segments are cut again."""
