"""Cohesive zones: bonded faces laid where the stress calls for them, and where zones begin."""
