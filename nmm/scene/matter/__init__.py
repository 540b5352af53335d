"""Materials and interfaces of a scene."""
