"""Water: pressures on edges and in joints, seepage through blocks, flow in joints."""
