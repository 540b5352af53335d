"""Steps in time as long as their error lets: how it is estimated, and what lengths follow."""
