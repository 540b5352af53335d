"""Water: pressures on edges, seepage and consolidation in blocks, flow in joints."""
