"""Texts of scenes that small scenes of single features are put together from, by subject."""
