"""One step: its equations, its solution with and without contact, what is kept of it.

How many steps there are, and how long, is decided in `drive`.
"""
