"""Nucleation: places where cracks may begin, stress along lines from them, the criterion."""
