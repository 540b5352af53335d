"""Motion in time: rotation, integrators, steps by their error, waves, shaken ground."""
