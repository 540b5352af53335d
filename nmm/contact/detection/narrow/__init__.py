"""The narrow phase in compiled code: which near vertices and edges are contacts. No search."""
