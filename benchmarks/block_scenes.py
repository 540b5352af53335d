"""Blocks in contact as bare problems, rows built by hand: no search, no scene."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy.sparse import block_diag, csc_array, csr_array
from scipy.spatial import Voronoi

from integration.moments import moments
from integration.polygons import Polygons
from nmm.contact.problem.step_problem import STICK, Limits, StepAnswer, StepProblem

YOUNG, POISSON, DENSITY, FRICTION, GRAVITY = 1e9, 0.2, 2000.0, 0.6, 9.81


@dataclass(frozen=True)
class Joints:
    """Straight joints: block on side a and side b (-1 is the ground), end points (j, 2)."""

    side_a: np.ndarray
    side_b: np.ndarray
    start: np.ndarray
    end: np.ndarray


@dataclass(frozen=True)
class Scene:
    """Blocks with six unknowns each (u0, v0, r0, ex, ey, gxy) and the points where they touch."""

    mass: csc_array
    stiffness: csc_array
    volume: np.ndarray
    problem: StepProblem
    step: float
    damping: float

    @property
    def matrix(self) -> csc_array:
        """Inertia and elasticity of a step."""
        return csc_array(2 / self.step**2 * self.mass + self.stiffness)

    def load(self, lateral: float) -> np.ndarray:
        """Weight and a lateral acceleration (m/s2)."""
        force = np.zeros((len(self.volume), 6))
        force[:, 0] = DENSITY * self.volume * lateral
        force[:, 1] = -DENSITY * self.volume * GRAVITY
        return force.ravel()


def wall(n_blocks: int, penalty: float = 1.0, step: float = 1e-3, **options: float) -> Scene:
    """Running bond on a floor: bricks 0.5 x 0.25, half bricks at alternate ends."""
    rows = max(2, round(np.sqrt(n_blocks)))
    per_row = max(2, round(n_blocks / rows))
    boxes, level = [], []
    for row in range(rows):
        cuts = (
            np.arange(per_row + 1) * 0.5
            if row % 2 == 0
            else np.r_[0, 0.25 + np.arange(per_row) * 0.5, per_row * 0.5]
        )
        boxes += [(a, row * 0.25, b, row * 0.25 + 0.25) for a, b in pairwise(cuts)]
        level += [row] * (len(cuts) - 1)
    boxes, level = np.array(boxes), np.array(level)
    polygons = [np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]) for x0, y0, x1, y1 in boxes]
    a, b, start, end = [], [], [], []
    by_level = [np.flatnonzero(level == row) for row in range(rows)]
    for row, members in enumerate(by_level):
        for left, right in pairwise(members):
            a.append(right), b.append(left)
            x, y0, y1 = boxes[left, 2], boxes[left, 1], boxes[left, 3]
            start.append((x, y1)), end.append((x, y0))
        for upper in members:
            lower = by_level[row - 1] if row else [-1]
            for below in lower:
                x0, x1 = boxes[upper, 0], boxes[upper, 2]
                if below >= 0:
                    x0, x1 = max(x0, boxes[below, 0]), min(x1, boxes[below, 2])
                if x1 - x0 > 1e-9:
                    a.append(upper), b.append(below)
                    start.append((x0, boxes[upper, 1])), end.append((x1, boxes[upper, 1]))
    joints = Joints(np.array(a), np.array(b), np.array(start), np.array(end))
    return _scene(polygons, joints, penalty, step, **options)


def pile(n_blocks: int, penalty: float = 1.0, step: float = 1e-3, **options: float) -> Scene:
    """Voronoi cells of random points in a box of side sqrt(n)/2 with floor and two walls."""
    rng = np.random.default_rng(n_blocks)
    side = 0.5 * np.sqrt(n_blocks)
    points = rng.random((n_blocks, 2)) * side
    for _ in range(3):
        points = np.array([p.mean(axis=0) for p in _cells(points, side)[0]])
    polygons, ridges, vertices = _cells(points, side)
    a, b, start, end = [], [], [], []
    for (left, right), (i, j) in ridges:
        p, q = vertices[i], vertices[j]
        if left >= n_blocks:
            left, right = right, left
        if left >= n_blocks or np.linalg.norm(p - q) < 1e-6:
            continue
        other = right if right < n_blocks else -1
        if other < 0 and min(p[1], q[1]) > side - 1e-9:
            continue  # the box is open above
        centre = polygons[left].mean(axis=0)
        if np.cross(np.r_[q - p, 0], np.r_[centre - p, 0])[2] < 0:
            p, q = q, p
        a.append(left), b.append(other), start.append(p), end.append(q)
    joints = Joints(np.array(a), np.array(b), np.array(start), np.array(end))
    return _scene(polygons, joints, penalty, step, **options)


def incline(n_blocks: int = 1, penalty: float = 1.0, step: float = 1e-3, **options: float) -> Scene:
    """Square blocks of 0.5 m in a row on a slope of 30 degrees that holds 20: all slide."""
    along, out = np.array([np.sqrt(3) / 2, 0.5]), np.array([-0.5, np.sqrt(3) / 2])
    foot = along * np.arange(n_blocks)[:, None]
    corners = [0 * along, 0.5 * along, 0.5 * (along + out), 0.5 * out]
    polygons = [p + np.array(corners) for p in foot]
    ground = np.full(n_blocks, -1)
    joints = Joints(np.arange(n_blocks), ground, foot, foot + 0.5 * along)
    options = {"friction": float(np.tan(np.radians(20)))} | options
    return _scene(polygons, joints, penalty, step, **options)


def supports(
    n_blocks: int = 1, penalty: float = 1.0, step: float = 1e-3, **options: float
) -> Scene:
    """Beams of 2 m x 0.25 m, each on two flat supports: eight forces for six unknowns."""
    left = np.stack([2.5 * np.arange(n_blocks), np.zeros(n_blocks)], axis=1)
    corners = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 0.25), (0.0, 0.25)])
    polygons = [p + corners for p in left]
    far, reach = np.array([1.6, 0.0]), np.array([0.4, 0.0])
    start = np.concatenate([left, left + far])
    number = np.tile(np.arange(n_blocks), 2)
    joints = Joints(number, np.full(2 * n_blocks, -1), start, start + reach)
    return _scene(polygons, joints, penalty, step, **options)


def _cells(points: np.ndarray, side: float) -> tuple[list, list, np.ndarray]:
    mirrored = [points]
    for axis in (0, 1):
        for at in (0.0, side):
            copy = points.copy()
            copy[:, axis] = 2 * at - copy[:, axis]
            mirrored.append(copy)
    diagram = Voronoi(np.vstack(mirrored))
    polygons = []
    for i in range(len(points)):
        p = diagram.vertices[diagram.regions[diagram.point_region[i]]]
        centre = p.mean(axis=0)
        polygons.append(p[np.argsort(np.arctan2(*(p - centre).T[::-1]))])
    ridges = list(zip(diagram.ridge_points, diagram.ridge_vertices, strict=True))
    return polygons, ridges, diagram.vertices


def _scene(
    polygons: list,
    joints: Joints,
    penalty: float,
    step: float,
    friction: float = FRICTION,
    damping: float = 1.0,
) -> Scene:
    rings = Polygons.from_vertices(polygons)
    area, centre, second = rings.areas, rings.centroids, moments(rings, 2)[:, 3:]
    mass = block_diag(
        [DENSITY * _mass(a, s) for a, s in zip(area, second, strict=True)], format="csc"
    )
    factor = YOUNG / (1 - POISSON**2)
    plane = factor * np.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]])
    elastic = []
    for a in area:
        block = np.zeros((6, 6))
        block[3:, 3:] = a * plane
        elastic.append(block)
    point = np.concatenate([joints.start, joints.end])
    side_a, side_b = np.tile(joints.side_a, 2), np.tile(joints.side_b, 2)
    tangent = np.tile(joints.end - joints.start, (2, 1))
    tangent = tangent / np.linalg.norm(tangent, axis=1)[:, None]
    normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    n, m = 6 * len(area), len(point)
    ones = np.ones(m)
    problem = StepProblem(
        matrix=csc_array((n, n)),
        force=np.zeros(n),
        normal_rows=_rows(point, side_a, side_b, normal, centre, n),
        tangent_rows=_rows(point, side_a, side_b, tangent, centre, n),
        gap=0 * ones,
        slip=0 * ones,
        normal_stiffness=penalty * YOUNG * ones,
        shear_stiffness=penalty * YOUNG * ones,
        limits=Limits(0 * ones, 0 * ones, friction * ones),
        state=np.full(m, int(STICK)),
        normal_force=0 * ones,
        shear_force=0 * ones,
    )
    scene = Scene(csc_array(mass), csc_array(block_diag(elastic)), area, problem, step, damping)
    return replace(scene, problem=replace(problem, matrix=scene.matrix))


def _rows(point, side_a, side_b, direction, centre, n) -> csr_array:
    values, columns = [], []
    for side, sign in ((side_a, 1.0), (side_b, -1.0)):
        x, y = (point - centre[np.maximum(side, 0)]).T
        zero, one = np.zeros_like(x), np.ones_like(x)
        u = np.stack([one, zero, -y, x, zero, y / 2], axis=1)
        v = np.stack([zero, one, x, zero, y, x / 2], axis=1)
        row = sign * (direction[:, :1] * u + direction[:, 1:] * v) * (side >= 0)[:, None]
        values.append(row)
        columns.append(6 * np.maximum(side, 0)[:, None] + np.arange(6))
    index = np.repeat(np.arange(len(point)), 12)
    data, column = np.hstack(values).ravel(), np.hstack(columns).ravel()
    keep = np.hstack([np.repeat((s >= 0)[:, None], 6, axis=1) for s in (side_a, side_b)]).ravel()
    rows = csr_array((data[keep], (index[keep], column[keep])), shape=(len(point), n))
    rows.sort_indices()
    return rows


def _mass(area: float, second: np.ndarray) -> np.ndarray:
    xx, xy, yy = second
    mass = np.diag([area, area, xx + yy, xx, yy, (xx + yy) / 4])
    mass[2, 3], mass[2, 4], mass[2, 5] = -xy, xy, (xx - yy) / 2
    mass[3, 5], mass[4, 5] = xy / 2, xy / 2
    return np.triu(mass) + np.triu(mass, 1).T


@dataclass
class Motion:
    """Steps of a scene under a lateral acceleration that grows by ``rate`` m/s2 a step."""

    scene: Scene
    rate: float = 0.05

    def __post_init__(self) -> None:
        n = self.scene.problem.force.size
        self.velocity, self.deformation, self.count = np.zeros(n), np.zeros(n), 0
        self.problem = self.next_problem(None)

    def next_problem(self, answer: StepAnswer | None) -> StepProblem:
        """Problem of the next step; ``answer`` is that of the last one."""
        scene = self.scene
        problem = scene.problem
        if answer is not None:
            self.deformation += answer.increment
            self.velocity = scene.damping * (2 * answer.increment / scene.step - self.velocity)
            problem = replace(
                self.problem,
                gap=answer.gap,
                slip=answer.slip,
                state=answer.state,
                normal_force=answer.normal_force,
                shear_force=answer.shear_force,
            )
        force = scene.load(self.rate * self.count) - scene.stiffness @ self.deformation
        force += 2 / scene.step * (scene.mass @ self.velocity)
        self.count += 1
        self.problem = replace(problem, force=force)
        return self.problem
