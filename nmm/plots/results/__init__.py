"""One picture of a run a file. Those of studies are in `plots`."""
