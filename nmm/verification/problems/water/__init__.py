"""Water pressures, seepage, consolidation and flow in joints."""
