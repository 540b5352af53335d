"""Water: pressures on edges, seepage and consolidation in blocks, flow in joints.

How fields diffuse is in `diffusion`.
"""
