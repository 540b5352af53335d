"""What no run is needed for: loads and factors over which nothing can hold (static theorem)."""
