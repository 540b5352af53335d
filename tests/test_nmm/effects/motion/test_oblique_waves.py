"""Waves that meet a viscous boundary at an angle are reflected as theory says."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import splu

import nmm
from integration.rules import polygon_rule
from nmm.effects.base import Instant
from nmm.stepping.prepare import prepare

# Density, Lame's constants equal (Poisson's ratio 1/4), and so the speeds of both waves.
SHEAR = 1.0
SPEED = {"SV": 1.0, "P": np.sqrt(3.0)}
WAVE, SPREAD, HEIGHT = 1.0, 1.1, 3.6
SCENE = """
title = "packet of waves"
plane = "strain"
duration = 100.0
[materials.ground]
young_modulus = 2.5
poisson_ratio = 0.25
density = 1.0
[[blocks]]
name = "ground"
material = "ground"
vertices = [[0, 0], [20, 0], [20, 7.5], [0, 7.5]]
[[viscous_boundaries]]
name = "base"
segment = [[0, 0], [20, 0]]
[inertia]
[formulation.cover]
type = "quads"
size = 0.1
degree = 0
[formulation.integrator]
type = "newmark"
step = 1.0
[formulation.rotation]
update = "small"
"""


def packet(points, kind, angle):
    """Displacement (m, 2) and velocity (m, 2) of a packet of one kind that goes down at an angle.

    They are derivatives of a potential, ``exp(-r^2 / 2 s^2) cos(k a) / k`` about its centre.
    """
    way = np.array([np.sin(angle), -np.cos(angle)])
    beside = np.array([-way[1], way[0]])
    from_centre = points - np.array([5.0, HEIGHT])
    along, across = from_centre @ way / SPREAD, from_centre @ beside / SPREAD
    number = 2 * np.pi / WAVE * SPREAD
    envelope = np.exp(-(along**2 + across**2) / 2) * SPREAD / number
    wave, slope = np.cos(number * along), number * np.sin(number * along)
    first = -envelope * (along * wave + slope)
    second = envelope * ((along**2 - 1 - number**2) * wave + 2 * along * slope)
    moved = np.stack([first, -across * envelope * wave], axis=1)
    faster = -SPEED[kind] / SPREAD * np.stack([second, -across * first], axis=1)
    axes = np.array([way, beside]) if kind == "P" else np.array([beside, -way])
    return moved @ axes, faster @ axes


def reflected(kind, angle):
    """Share of the energy of a plane wave that two dashpots send back, at an angle (rad).

    Amplitudes of both waves that go back follow from the tractions of the dashpots.
    """
    p, s = SPEED["P"], SPEED["SV"]
    along = np.sin(angle) / SPEED[kind]
    down = {"P": np.sqrt(1 / p**2 - along**2 + 0j), "SV": np.sqrt(1 / s**2 - along**2 + 0j)}

    def conditions(wave, up):
        slow = np.array([along, up * down[wave]])
        moves = slow * p if wave == "P" else np.array([-slow[1], slow[0]]) * s
        normal = slow @ moves + 2 * slow[1] * moves[1] + p * moves[1]
        shear = slow[0] * moves[1] + slow[1] * moves[0] + s * moves[0]
        return np.array([normal, shear])

    matrix = np.stack([conditions("P", 1), conditions("SV", 1)], axis=1)
    found = np.abs(np.linalg.solve(matrix, -conditions(kind, -1))) ** 2
    flux = np.array([p**2 * down["P"].real, s**2 * down["SV"].real])
    return float(found @ flux / flux[0 if kind == "P" else 1])


PRESSURE = [("P", 30, 0.00031), ("P", 60, 0.03590), ("P", 85, 0.58633)]
SHEARED = [("SV", 15, 0.00297), ("SV", 30, 0.03590), ("SV", 45, 0.02869), ("SV", 60, 0.11325)]


@pytest.mark.parametrize(("kind", "degrees", "share"), PRESSURE + SHEARED)
def test_the_reference_has_the_shares_of_tables(kind, degrees, share):
    assert reflected(kind, np.radians(degrees)) == pytest.approx(share, abs=1e-5)


def mean_share(kind, angle):
    """Of a packet: its energy lies about the middle wave number as its shape says."""
    number, deviation = 2 * np.pi / WAVE, 1 / SPREAD / np.sqrt(2)
    offsets = np.linspace(-3.5, 3.5, 41) * deviation
    along, across = np.meshgrid(number + offsets, offsets)
    weight = np.exp(-((along - number) ** 2 + across**2) * SPREAD**2) * (along**2 + across**2)
    angles = angle + np.arctan2(across, along)
    inside = np.abs(angles) < np.pi / 2
    shares = [reflected(kind, one) for one in angles[inside]]
    return float(weight[inside] @ shares / weight.sum())


@pytest.mark.slow  # half a minute each: 30 000 unknowns, some 300 steps
@pytest.mark.parametrize(("kind", "degrees"), [("SV", 60), ("SV", 45), ("P", 60)])
def test_the_share_of_energy_that_comes_back_is_that_of_theory(kind, degrees):
    scene = nmm.parse_scene(SCENE)
    made = prepare(scene, scene.formulation)
    stepper, model = made.stepper, made.stepper.model
    rule = polygon_rule(model.manifold.elements, 4)
    rows = model.manifold.rows(rule.owner, rule.points)
    factor = splu(model.mass)

    def projected(values):
        local = rows.along(rule.weights[:, None] * values)
        n = model.manifold.n_unknowns
        return factor.solve(np.bincount(rows.unknowns.ravel(), local.ravel(), minlength=n))

    fields = [projected(field) for field in packet(rule.points, kind, np.radians(degrees))]
    state = replace(made.start, deformation=fields[0], velocity=fields[1])
    speed = SPEED[kind]
    step = WAVE / speed / 24
    travel = 2 * HEIGHT / np.cos(np.radians(degrees)) / speed

    def energy(one):
        kinetic = one.velocity @ (model.mass @ one.velocity)
        return (kinetic + one.deformation @ (model.stiffness @ one.deformation)) / 2

    first = energy(state)
    for _ in range(round(0.95 * travel / step)):
        attempt = stepper.attempt(state, Instant(state.time + step, 1.0), step)
        assert attempt.converged
        state, _ = stepper.accept(attempt)
    expected = mean_share(kind, np.radians(degrees))
    assert energy(state) / first == pytest.approx(expected, abs=0.02)
