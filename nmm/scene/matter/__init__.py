"""Materials and interfaces of a scene. Their laws are in `materials` and `interfaces`."""
