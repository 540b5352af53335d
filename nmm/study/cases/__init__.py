"""One case of a study: its variant, its run, its cost, its record.

Many of them are run in `sweep`.
"""
