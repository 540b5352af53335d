"""The interior point on Coulomb's law: sides of contacts, its equations, path and starts.

Newton's method on springs, tried from points of the path, is in `newton`; what calls the interior
point, and when, stands a room above.
"""
