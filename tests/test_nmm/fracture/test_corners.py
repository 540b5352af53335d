"""Corners of boundaries and kinks."""

import numpy as np
import pytest

from nmm.formulation import CoverTable
from nmm.fracture.corners import kinks
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.verification.continuum import polygon

NET = CoverTable.model_validate({"type": "triangles", "size": 0.2, "degree": 1, "angle": 0.2})


def test_a_kink_has_a_corner_on_its_outer_side():
    ring = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    turn = np.radians([10.0, 80.0])
    ways = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    start, kink = np.array([-1.2, -0.2]), np.array([0.05, 0.02])
    line = np.array([start, kink - 0.3 * ways[0], kink, kink + 0.4 * ways[1]])
    model = solid(polygon(ring), NET, [Elastic(1.0, 0.3)], "strain", cracks=[line])
    (corner,) = kinks(model.cut.boundary, line)  # the first vertex hardly turns
    assert corner.point == pytest.approx(kink)
    assert np.degrees(corner.angle) == pytest.approx(250.0)
    # Half way between straight back along the first piece and straight ahead along the second.
    outward = np.radians(80.0 - 125.0)
    assert corner.direction == pytest.approx([np.cos(outward), np.sin(outward)])
