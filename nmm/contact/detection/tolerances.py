"""All numbers that steer the geometry of contact, with their units and reasons."""

from typing import NamedTuple

# What counts as penetration, and as flush.

DEPTH = 0.1
"""Of the thinner body's thickness: how far a vertex is followed into another body, and beyond which
it has gone through. Deeper, the nearest edge may be that of the other side."""
ANGLE = 0.05
"""rad: Shi's three degrees. Edges that turn further from each other do not face each other; solids
may overlap by as much at an entrance."""
FLUSH = 1e-3
"""Of the thinner body's thickness: steps and gaps between neighbours below it are flush, as those
that penetration makes in a wall are, some 1e-4."""
FACING = 0.9
"""Cosine between the normals of faces that a vertex may slide along one after the other: 26
degrees, so that its forces do not turn with it round the corner of a block."""
MERGED_BODIES = 4
"""Bodies around one point that a vertex may be merged with, on either side: as many as meet in a
wall of bricks."""

# Rounding: lengths that are equal but for arithmetic.

EDGE_END = 1e-9
"""Of an edge's length: a foot that is no further beyond the end is on the edge."""
RANKED = 1e-6
"""Of the reach of a search: gaps that differ by less are equally good entrances."""
REENTRANT = 1e-9
"""Sine of the turn of a corner below which it is even."""
CROSSED_FIRST = 1e-9
"""Share of the depth by which another edge must be nearer: a corner lies as far from both."""
SAME_POINT = 1e-9
"""Of the mean edge: ends of edges that are no further apart are one point."""
SAME_PLACE = 1e-9
"""Of the size of the domain: points of two models that are nearer are one, far above rounding and
far below cells."""
SWEPT_AREA = 1e-9
"""Of an area that a vertex sweeps about an edge: by how much it may be off, with much to spare."""
SAME_ROWS = 1e-12
"""Of the largest entry: rows of chord and material that differ by less are the same, and the field
linear along the edge."""
SAME_COMPLIANCE = 1e-9
"""Share by which one face follows a pressure more easily before the choice between two is its."""

# Joints.

JOINT = 1e-6
"""Of the mean edge: largest distance of edges that share a joint, and length it must exceed."""
JOINT_LEFT = 0.05
"""Of a joint's length: a broken one whose faces have slid so far is left to the search; sooner, the
search could not tell its ends from the joint's."""
WHOLLY_HELD = 1 - 1e-6
"""Of an edge's length: what joints hold of one that has no more of it for contacts."""

# Faces.

FACE_WALK = 8
"""Edges that faces are followed beyond what the search found: it reaches an edge or two."""
RUN_APART = 1.5
"""Intervals of multiplier nodes: points further apart lie on runs of their own."""
KINK = 0.5
"""rad: turn of a boundary at which one face ends and another begins."""
ALIKE_COSINE = 0.3
"""Cosine between the functions at two corners from which on they count as alike. Under Hertz's
cylinder pressures of degree 0 are off by 1 % at most with 0.3, by 3 % with 0.1, 13 % with 0.5."""
ALIKE_FINE = 0.85
"""The same on segments of faces with fewer than `ENOUGH_NODES` nodes between their ends."""
ENOUGH_NODES = 3
"""Nodes inside a stretch from which on it is held often enough: with one alone two blocks of three
cells turned into each other by 1 % of their size, and moved 2.5 times as far."""

# How far, and how often, a step looks.

SKIN = 0.05
"""Of the thickness of the thinnest body: least skin of the list of neighbours, half of `DEPTH`.
Steps that grow from rest then outgrow no list, and a list is a quarter wider at most."""
FIRST_REACH = 1e-6
"""Of the domain's size: how far contacts are sought in the first step, which knows no motion."""
FURTHER = 1.5
"""Motions of a step that moved further than contacts were sought: how far it seeks them again."""
CROSSING_SOLUTIONS = 4
"""How often a step is solved again for vertices that crossed edges they were no contacts of."""
MIDPOINT_SOLUTIONS = 4
"""How often a step is solved again with contact forces where they act at its middle."""
MIDPOINT_GAPS = 1e-4
"""Share of the penetrations by which gaps may be off for the rotation of bodies within a step."""
MIDPOINT_GAPS_OF_MESHES = 1e-5
"""The same where forces act half way on bodies of many elements."""
MIDPOINT_STRAIN = 0.2
"""Of how far strain moves a body's corners: what gaps at the start of a step miss as it turns.

They miss what of it lies along faces. With 1 the same steps of soft blocks are found, and two more
of the first twenty of an arch; with 0.1 such blocks gain as much as with none.
"""
MIDPOINT_WAYS = 1e-4
"""Of the way to half way: what counts for a penetration where it is more, as exact contacts leave
none but rounding, which would decide."""
MIDPOINT_WAYS_OF_MESHES = 0.2
"""The same on meshes, so that energy is right to a share of what forces may do in the step."""


class Rules(NamedTuple):
    """Numbers of the narrow phase, see `narrow_phase.find_contacts`.

    Attributes
    ----------
    reach, grain, rounding
        Largest gap, the step in which gaps are ranked, and the rounding of coordinates (m).
    depth, flush
        Fractions of the thickness of the thinner body.
    sine
        Of the angular tolerance.
    end
        Fraction of an edge that a foot may lie beyond its end.
    """

    reach: float
    grain: float
    rounding: float
    depth: float
    flush: float
    sine: float
    end: float
