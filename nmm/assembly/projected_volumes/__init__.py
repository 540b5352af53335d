"""Projected pressures: volumetric stiffness by pressures on patches, against locking."""
