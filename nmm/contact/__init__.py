"""Contact of bodies: search, pairs, gap rows and their enforcement."""
