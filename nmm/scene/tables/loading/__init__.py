"""Tables of loads, what grows in their place, the fields they are given by, files of numbers."""
