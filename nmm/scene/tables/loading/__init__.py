"""Tables of loads, the fields that they are given by, and files of numbers."""
