"""Runs side by side on one page: of one scene, or of several scenes of one case."""
