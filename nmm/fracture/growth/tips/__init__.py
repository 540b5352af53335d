"""Crack tips in a state: intensity factors, parallel stress, and which of them are loaded."""
