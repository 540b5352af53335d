"""Heat conduction and thermal strain, steady and in time."""
