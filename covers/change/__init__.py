"""From one manifold to the next on the same material: what became of what, and fields carried over.

Nothing here says why a manifold changes, and nothing knows of materials but their weight.
"""
