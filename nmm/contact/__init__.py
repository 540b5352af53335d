"""Contact: search, gaps and joints; one file for each enforcement.

Interface laws are in `interfaces`; glue and supports are in `constraints`.
"""
