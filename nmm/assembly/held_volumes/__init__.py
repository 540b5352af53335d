"""Changes of volume that are held by pressures on patches, beside the stress of each point."""
