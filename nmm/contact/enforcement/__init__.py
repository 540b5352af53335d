"""Contact enforcements, one file each, and those that wrap any of them."""
