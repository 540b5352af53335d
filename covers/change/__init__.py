"""From one manifold to the next on the same material: parentage, and transfer of fields.

Nothing here says why a manifold changes, nor knows of materials beyond density and elasticity.
"""
