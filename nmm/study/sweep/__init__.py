"""Many cases from a study file: run, stored, summarised."""
