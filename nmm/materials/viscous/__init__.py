"""Laws of matter that creeps: elastic in volume, springs and dashpots in shape."""
