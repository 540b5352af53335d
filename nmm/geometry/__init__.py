"""Geometry: the blocks of a scene from corners, tessellations and joint sets; imports; checks.

Cutting by covers is in `covers.cutting`.
"""

# Eager, as the module `regions` would else hide the function of the same name.
from nmm.geometry.blocks import Regions
from nmm.geometry.regions import regions
from nmm.geometry.tessellation.cutting import cut
from nmm.geometry.tessellation.joint_sets import JointSetGeometry
from nmm.geometry.tessellation.voronoi import tessellate

__all__ = ["JointSetGeometry", "Regions", "cut", "regions", "tessellate"]
