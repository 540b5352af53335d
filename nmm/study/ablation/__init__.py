"""Which effects of a scene matter: it is run with each of them left out in turn."""
