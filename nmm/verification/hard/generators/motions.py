"""Random bodies that fly, turn and meet: the same motion wherever and however it is written."""

from collections.abc import Iterator

import numpy as np

from integration.arrays import Floats
from nmm.verification.base import Check, Checks, limit
from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.cases.parts import (
    BLOCKS,
    enforcements,
    integrators_of_contact,
    meshes,
    solvers,
    with_integrator,
    with_parts,
)
from nmm.verification.hard.cases.transforms import (
    listed_anew,
    mirrored,
    shifted,
    turned,
)
from nmm.verification.hard.cases.units import in_units
from nmm.verification.hard.cases.writing import block, rock
from nmm.verification.hard.oracles.linear import monitored
from nmm.verification.hard.oracles.motion import (
    Ran,
    body_checks,
    ended,
    energies,
    energy_checks,
    momentum_checks,
    ran,
    turnover,
)

STEPS = 25

HARD, SOFT = (-4.0, -2.5), (-2.5, -1.5)
"""Decimal logarithms of speeds over that of waves: strains of 1e-4 to 3e-3, and up to 3e-2."""

SWAY = 0.2
"""Largest energy that soft bodies may gain in a run if they say so, in the turnover."""


class Motions(HardClass):
    """Two to five random convex bodies that are thrown at each other."""

    name = "motions"
    title = (
        "random bodies thrown at each other, one of them cracked in some, soft in one, any cover, "
        "enforcement, integrator and solver"
    )
    oracle = (
        "momentum, energy never rises, nobody through anybody; the same after shift, turn, mirror, "
        "units, order; history = summary = frames; the plan names what the scene names"
    )
    share = 5

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield one random scene with every enforcement and one cover each, and further ones."""
        random = np.random.default_rng([seed, 71])
        scene, size = thrown(random)
        covers = {**BLOCKS, **meshes(0.45 * size, (0, 1))}
        names, forces, times = list(covers), enforcements(), integrators_of_contact()
        lists = [name for name in solvers() if name != "qdldl"]
        for number in range(max(len(forces), 4)):
            cover = names[(seed * 5 + number) % len(names)] if number else names[seed % 3]
            parts = {
                "cover": cover,
                "enforcement": forces[number % len(forces)],
                "integrator": times[(seed + number) % len(times)],
                "solver": lists[(seed + number) % len(lists)],
            }
            made = with_parts(
                scene,
                {
                    "cover": covers[cover],
                    "contact.enforcement": parts["enforcement"],
                    **with_integrator(parts["integrator"]),
                    "solver.type": parts["solver"],
                },
            )
            label = f"seed {seed}, {', '.join(parts.values())}"
            yield HardCase(label, made, _judge, parts)
        cover = list(meshes(size))[seed % len(meshes(size))]
        parts = {"cover": cover, "enforcement": forces[seed % len(forces)]}
        made = with_parts(
            cracked(scene),
            {"cover": meshes(0.45 * size)[cover], "contact.enforcement": parts["enforcement"]},
        )
        yield HardCase(f"seed {seed}, cracked, {', '.join(parts.values())}", made, _judge, parts)
        yield _soft(seed)


def _soft(seed: int) -> HardCase:
    """Return soft bodies on a mesh: thrown so fast that they bend and are turned by impacts."""
    scene, size = thrown(np.random.default_rng([seed, 73]), SOFT)
    covers, forces = meshes(0.45 * size, (0, 1)), enforcements()
    times = [one for one in integrators_of_contact() if one != "energy_momentum"]
    parts = {
        "cover": list(covers)[seed % len(covers)],
        "enforcement": forces[seed // 2 % len(forces)],
        "integrator": times[seed % len(times)],
    }
    made = with_parts(
        scene,
        {
            "cover": covers[parts["cover"]],
            "contact.enforcement": parts["enforcement"],
            **with_integrator(parts["integrator"]),
        },
    )
    return HardCase(f"seed {seed}, soft, {', '.join(parts.values())}", made, _judge_soft, parts)


def thrown(
    random: np.random.Generator, speeds: tuple[float, float] = HARD
) -> tuple[Document, float]:
    """Return the tables of bodies on a ring that fly inwards, and how large they are (m).

    ``speeds`` are the decimal logarithms of the least and the largest over that of waves.
    """
    count, size = int(random.integers(2, 5)), float(10.0 ** random.uniform(-1, 1))
    angles = 2 * np.pi * (np.arange(count) + random.uniform(-0.1, 0.1, count)) / count
    ring = 0.5 * size / np.sin(np.pi / max(count, 3)) * 1.05
    friction = float(random.choice([0.0, 0.0, 20.0, 35.0]))
    scene = rock(
        modulus=float(10.0 ** random.uniform(7, 10.5)),
        poisson=float(random.choice([0.0, 0.2, 0.3, 0.4])),
        friction=friction,
    )
    scene["plane"] = str(random.choice(["strain", "stress"]))
    wave = np.sqrt(scene["materials"]["rock"]["young_modulus"] / 2600.0)
    speed = float(wave * 10.0 ** random.uniform(*speeds))
    step = float(0.25 * size / STEPS / speed * random.uniform(0.5, 2.0))
    tables, flights, points = [], [], []
    for number, angle in enumerate(angles):
        corners = _convex(random, 0.45 * size)
        centre = ring * np.array([np.cos(angle), np.sin(angle)])
        tables.append(block(f"b{number}", corners + centre))
        velocity = -speed * centre / ring + 0.1 * speed * random.normal(size=2)
        turning = float(0.2 * speed / size * random.normal())
        flights.append(
            {"block": f"b{number}", "velocity": velocity.tolist(), "angular_velocity": turning}
        )
        inside = (corners + centre).mean(axis=0).tolist()
        points.append({"name": f"m{number}", "point": inside, "block": f"b{number}"})
    scene |= {
        "blocks": tables,
        "initial_velocities": flights,
        "monitors": points,
        "inertia": {},
        "duration": STEPS * step,
        "formulation": {"integrator": {"step": step}},
    }
    return scene, size


def cracked(scene: Document) -> Document:
    """Return a scene whose first body has a crack from the middle of a side past its centre."""
    ring = np.array(scene["blocks"][0]["vertices"])
    mouth, middle = ring[:2].mean(axis=0), ring.mean(axis=0)
    points = [mouth - 0.2 * (middle - mouth), mouth + 1.2 * (middle - mouth)]
    return {**scene, "cracks": [{"name": "crack", "points": np.array(points).tolist()}]}


def _convex(random: np.random.Generator, radius: float) -> Floats:
    """Corners of a convex body about the origin that reaches ``radius``."""
    count = int(random.integers(3, 8))
    angles = 2 * np.pi * (np.arange(count) + random.uniform(-0.35, 0.35, count)) / count
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _judge(scene: Document) -> Checks:
    found = ran(scene)
    checks = ended(found)
    if not found.run.summary.steps or found.run.summary.status != "converged":
        return checks
    checks |= energy_checks(found) | body_checks(found) | momentum_checks(scene, found)
    checks |= _records(scene, found)
    ways = monitored(found.run)
    images = {"order of blocks and corners": (listed_anew(scene, 3), np.eye(2))}
    images["shift by 1e4 sizes"] = (shifted(scene, _far(found)), np.eye(2))
    images["other units"] = (in_units(scene, 1e2, 1e4), 1e2 * np.eye(2))
    # A power of two changes no digit: what differs knows a force of its own.
    images["forces by a power of two"] = (in_units(scene, 1.0, 2.0**12), np.eye(2))
    if scene["formulation"]["cover"]["type"] == "block":  # nets would lie otherwise
        c, s = np.cos(1.1), np.sin(1.1)
        images["turn"] = (turned(scene, 1.1), np.array([[c, -s], [s, c]]))
        images["mirror"] = (mirrored(scene), np.diag([-1.0, 1.0]))
    for name, (image, matrix) in images.items():
        checks |= _same(name, image, ways, matrix)
    return checks


def _judge_soft(scene: Document) -> Checks:
    """What bends far gains energy in coarse steps: the run says so, and nothing else is off."""
    found = ran(scene)
    run = found.run
    if not run.summary.steps or run.summary.status not in ("converged", "unbalanced"):
        return ended(found)
    energy, rises = energies(found), energy_checks(found)
    climb = float((energy - np.minimum.accumulate(energy)).max() / turnover(found))
    checks = {
        "a rise is told": rises["a rise is told"],
        "rise in the run": limit(climb, SWAY, "bodies that turn within an impact"),
    }
    checks |= momentum_checks(scene, found, 1e-8, "contact is solved to 1e-8 of its forces")
    checks |= _records(scene, found)
    if run.summary.status == "converged":
        same = listed_anew(scene, 3)
        checks |= _same("order of blocks and corners", same, monitored(run), np.eye(2))
    return checks


def _far(found: Ran) -> tuple[float, float]:
    size = found.run.stepper.size
    return 1e4 * size, -0.7e4 * size


def _same(name: str, image: Document, ways: dict[str, Floats], matrix: Floats) -> Checks:
    found = ran(image)
    if found.run.summary.status != "converged":
        return {name: ended(found)["converged"]}
    seen = monitored(found.run)
    off = max(float(np.abs(seen[key] - matrix @ way).max()) for key, way in ways.items())
    scale = max(float(np.abs(matrix @ way).max()) for way in ways.values())
    # Contact is solved to 1e-8; impacts enlarge it by the ratio of way to penetration.
    return {name: Check(off / scale, 0.0, 1e-5, "tolerance of contact", 1.0)}


def _records(scene: Document, found: Ran) -> Checks:
    """Summary, history and frames say the same; effects that ran are those that are named."""
    run, h = found.run, found.run.history
    frame = run.frames[-1]
    places = np.abs(frame.points - run.stepper.place(run.state) - run.origin).max()
    size = np.abs(frame.points).max()
    wanted = {"inertia", "contact", "initial velocity"}
    strange = set(run.summary.effect_seconds) - wanted
    deepest = run.summary.largest_penetration or 0.0
    return {
        "steps of the summary": Check(float(run.summary.steps), float(len(h["step"])), 0.0, "rows"),
        "penetration of the summary": Check(deepest, float(h["penetration"].max()), 0.0, "rows"),
        "last time": Check(float(h["time"][-1]), scene["duration"], 1e-12, "the duration"),
        "last frame": Check(float(places / size), 0.0, 1e-12, "the last state", 1.0),
        "effects nobody named": Check(float(len(strange)), 0.0, 0.0, ", ".join(sorted(strange))),
    }
