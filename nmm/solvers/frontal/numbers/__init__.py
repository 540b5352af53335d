"""Numbers of factors on a plan of fronts, in compiled code: found, read, and the room for them."""
