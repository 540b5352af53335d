"""References that several hard cases are measured against."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp


def rates_on_a_corner(_, state, g):
    """Rates of (x, y, angle) and of theirs for a unit square whose face slides on a corner.

    The corner is the origin, the mass is one, and without friction the force acts along the normal
    of the face. Its size follows from the corner's staying on the face, (x, y) . normal = -1/2.
    """
    centre, angle, velocity, spin = state[:2], state[2], state[3:5], state[5]
    normal = np.array([np.cos(angle - np.pi / 4), np.sin(angle - np.pi / 4)])
    along = np.array([-normal[1], normal[0]])
    arm = along @ centre  # of the corner's force about the centre
    weight = np.array([0.0, -g])
    needed = normal @ weight + 2 * spin * (along @ velocity) - spin**2 * (normal @ centre)
    force = needed / (1 + 6 * arm**2)  # the moment of inertia is 1/6
    return np.concatenate([state[3:], weight - force * normal, [-6 * force * arm]])


@pytest.fixture(scope="session")
def tipped():
    """Way of the centre (2,) and rotation of a square that falls on a corner, 0.3 s after release.

    A side of 1 m, standing on a corner of its own, falls 0.05 m on a corner of a fixed square. The
    faces beside are parallel to those of the fixed one, so that whichever way rounding decides, the
    force that ends the fall turns the square over the fixed corner, on which its face then slides.
    No rebound: the blow takes the velocity of the face against the corner.
    """
    g, drop, end = 9.81, 0.05, 0.3
    fall = np.sqrt(2 * drop / g)
    centre, normal = np.array([0.0, np.sqrt(0.5)]), np.array([1.0, -1.0]) / np.sqrt(2)
    arm = np.array([-normal[1], normal[0]]) @ centre
    blow = g * fall * -normal[1] / (1 + 6 * arm**2)
    hit = np.array([0.0, -g * fall]) - blow * normal
    start = np.concatenate([centre, [0.0], hit, [-6 * blow * arm]])
    found = solve_ivp(rates_on_a_corner, (fall, end), start, args=(g,), rtol=1e-9, atol=1e-12)
    return found.y[:2, -1] - centre - [0, drop], found.y[2, -1]
