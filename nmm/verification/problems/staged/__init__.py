"""Problems of excavation and construction: what leaves, what arrives, and in which order."""
