"""Tables of loads, of path control and of fields, and files of numbers."""
