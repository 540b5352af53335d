"""Halved steps and cells: answers must come together, and those of all covers as well."""

from collections.abc import Iterator
from itertools import pairwise
from math import ceil, isfinite
from typing import Any

import numpy as np

from integration.arrays import Floats
from nmm.integrators.base import INTEGRATORS
from nmm.stepping.drive.stable_step import longest_step
from nmm.verification.base import Check, Checks, holds, limit
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import (
    integrators,
    meshes,
    solvers,
    with_integrator,
    with_parts,
)
from nmm.verification.hard.cases.writing import block
from nmm.verification.hard.generators.random_solids import solid
from nmm.verification.hard.oracles.linear import monitored
from nmm.verification.hard.oracles.motion import ended, prepared, ran


class Steps(HardClass):
    """Random smooth vibrations under every integrator, with steps halved twice."""

    name = "steps"
    title = "smooth vibrations, steps halved twice, every integrator and linear solver"
    oracle = (
        "differences fall by 1.8 and more; steps beyond the limit of an explicit integrator are "
        "refused; every solver gives the same"
    )
    share = 2

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield one random block under each integrator and solver."""
        random = np.random.default_rng([seed, 73])
        scene = _vibrating(random)
        for name in integrators():
            explicit = isfinite(INTEGRATORS.make(name).limit)
            # The consistent mass of degree 1 has no inverse, as functions depend on one another.
            fields = {"cover.degree": 0} if explicit else {}
            made = with_parts(scene, {**with_integrator(name), **fields})
            judge = _halved_below_the_limit if explicit else _halved
            yield HardCase(f"seed {seed}, {name}", made, judge, {"integrator": name})
        for name in solvers():
            made = with_parts(scene, {"solver.type": name})
            yield HardCase(f"seed {seed}, {name}", made, _solved_alike, {"solver": name})


class Agreement(HardClass):
    """A random body under every cover, with cells halved: all must come to one answer."""

    name = "agreement"
    title = "a random body under each cover beside quads of degree 2"
    oracle = "strain energies agree within three times their changes at halved cells"

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield one random body under every cover of degree 1 and 2."""
        random = np.random.default_rng([seed, 79])
        scene, size = solid(random)
        for name, cover in meshes(0.25 * size, (1, 2)).items():
            made = with_parts(scene, {"cover": cover})
            yield HardCase(f"seed {seed}, {name}", made, _agreed, {"cover": name})


def _vibrating(random: np.random.Generator) -> Document:
    """Tables of a held block with a smooth load that grows and falls, twenty steps a period."""
    width, height = random.uniform(0.5, 2.0, 2)
    corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]
    period = 4 * height / np.sqrt(1e9 / 2500)
    times = np.linspace(0, 4 * period, 41)
    factor = np.sin(np.pi * times / times[-1]) ** 4
    return {
        "plane": "stress",
        "duration": float(2 * period),
        "inertia": {},
        "materials": {
            "m": {"young_modulus": 1e9, "poisson_ratio": 0.25, "density": 2500.0},
        },
        "blocks": [block("b", corners, "m")],
        "supports": [{"name": "foot", "segment": corners[:2], "fix": ["x", "y"]}],
        "loads": [
            {
                "name": "push",
                "kind": "body",
                "block": "b",
                "density": random.normal(0, 1e5, 2).tolist(),
                "history": np.stack([times, factor], axis=1).tolist(),
            }
        ],
        "monitors": [{"name": "top", "point": [0.4 * width, 0.9 * height], "block": "b"}],
        "formulation": {
            "cover": {
                "type": "quads",
                "size": float(0.6 * height),
                "functions": "monomials",
                "degree": 1,
            },
            "integrator": {"step": float(period / 20)},
        },
    }


def _halved_below_the_limit(scene: Document) -> Checks:
    """Halve steps from 0.9 of the longest stable one; 1.05 of it must be refused."""
    ready = prepared(scene)
    longest = longest_step(ready.stepper, ready.start)
    beyond = ran(with_parts(scene, {"integrator.step": 1.05 * longest})).run.summary
    told = beyond.status == "failed" and "grow without bound" in beyond.sentence
    below = scene["duration"] / ceil(scene["duration"] / (0.9 * longest))
    checks = _halved(with_parts(scene, {"integrator.step": below}))
    return checks | {"a step beyond the limit is refused": holds(told, beyond.sentence)}


def _halved(scene: Document) -> Checks:
    step = scene["formulation"]["integrator"]["step"]
    ways: list[Floats] = []
    checks: Checks = {}
    for part in (1, 2, 4):
        found = ran(with_parts(scene, {"integrator.step": step / part}))
        checks |= ended(found)
        if not found.run.summary.steps:
            return checks
        ways.append(monitored(found.run)["top"])
    first, second = (float(np.linalg.norm(a - b)) for a, b in pairwise(ways))
    largest = float(np.linalg.norm(ways[-1])) or 1.0
    ratio = second / first if first > 1e-9 * largest else 0.0
    return checks | {"second over first difference": limit(ratio, 0.6, "first order or better")}


def _solved_alike(scene: Document) -> Checks:
    chosen = monitored(ran(scene).run)["top"]
    plain = monitored(ran(with_parts(scene, {"solver.type": "auto"})).run)["top"]
    off = float(np.abs(chosen - plain).max() / np.abs(plain).max())
    return {"difference from auto": Check(off, 0.0, 1e-8, "rounding", 1.0)}


def _agreed(scene: Document) -> Checks:
    """Compare strain energies with those of quads of degree 2 on cells of half the size."""
    cover: dict[str, Any] = scene["formulation"]["cover"]
    fine = {**cover, "size": cover["size"] / 2}
    other = {**fine, "type": "quads", "degree": 2}
    energies = []
    for table in (cover, fine, {**other, "size": cover["size"]}, other):
        found = ran(with_parts(scene, {"cover": table}))
        if found.run.summary.status != "converged":
            return ended(found)
        energies.append(float(found.run.history["strain_energy"][-1]))
    coarse, fine_one, coarse_other, fine_other = energies
    change = abs(coarse - fine_one) + abs(coarse_other - fine_other)
    off = abs(fine_one - fine_other) / (3 * change + 1e-4 * abs(fine_other))
    return {"distance over what halving changes": limit(off, 1.0, "errors fall by halving")}
