"""What a run says of its own answer: one file a group of audits, one table of thresholds.

Checks before a run are in `geometry.checks`.
"""
