"""Singular points: covers that carry their functions, branches of the angle, quadrature."""
