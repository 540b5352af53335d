"""Files with one small fault, and the sound ones that they are made from."""
