"""Static runs along a path: event by event, up and down the load.

What is controlled is in `controls`.
"""
