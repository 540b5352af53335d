"""Problems of matter that creeps, has directions, or is weakened until it fails."""
