"""Audits of matter: strains, softening, blocks that split, cracks that grow or close."""
