"""Contacts and crossings by whole arrays, and by trees: what the compiled search is held to."""
