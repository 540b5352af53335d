"""Contact points on the faces of cracks: which hold together, which are one, what they carry."""
