"""Traction laws of joints and contacts."""
