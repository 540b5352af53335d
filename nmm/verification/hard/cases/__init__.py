"""What a hard case is: scenes, every exchangeable part in turn, how tables are written and moved.

Which scenes there are is in `generators`.
"""
