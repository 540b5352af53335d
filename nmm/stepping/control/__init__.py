"""Static runs along a path: event by event, up and down the load."""
