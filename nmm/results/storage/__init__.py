"""The run folder on disk: written so that a kill loses nothing, locked, checked and read again."""
