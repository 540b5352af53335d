"""From a formulation's cover to a manifold: nets, degrees, singular functions."""
