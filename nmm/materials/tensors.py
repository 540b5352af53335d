"""Tensors as vectors: (xx, yy, xy) in the plane, (xx, yy, xy, zz) with what is across."""

import numpy as np

ISOTROPIC = np.array([1.0, 1.0, 0.0])
"""Unit isotropic tensor in the plane."""
SPHERICAL = np.array([1.0, 1.0, 0.0, 1.0])
"""The same in all three directions."""
TWICE = np.array([1.0, 1.0, 2.0, 1.0])
"""How often components count in the norm of a tensor, and what makes shears strains 2 xy."""
DEVIATOR = np.array([[2 / 3, -1 / 3, 0.0], [-1 / 3, 2 / 3, 0.0], [0.0, 0.0, 0.5]])
"""From strain (xx, yy, 2 xy) to its deviator (xx, yy, xy) where nothing strains along z."""
