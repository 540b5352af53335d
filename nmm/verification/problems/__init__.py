"""The benchmark problems, by subject; what they share is in `nmm.verification`."""
