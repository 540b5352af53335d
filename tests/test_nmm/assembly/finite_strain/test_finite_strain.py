"""Forces of finite strain: rotations without stress, tangents, what a conserving step keeps."""

import numpy as np
import pytest

from covers.approximation.own_rule import own_rule
from integration.polygons import Polygons
from nmm.formulation import parse_formulation
from nmm.materials.elastic import Elastic
from nmm.materials.neo_hookean import NeoHookean
from nmm.model.from_polygons import solid

COVERS = {
    "block": 'type = "block"',
    "block of degree 2": 'type = "block"\nfunctions = "monomials"\ndegree = 2',
    "triangles": 'type = "triangles"\nsize = 0.7\nangle = 0.3\ndegree = 1',
    "quads": 'type = "quads"\nsize = 0.7\ndegree = 0',
    "splines": 'type = "bspline"\nsize = 0.6\ndegree = 0',
    "meshless": 'type = "mls"\nsize = 0.5\ndegree = 1',
}
LAWS = {"St Venant-Kirchhoff": Elastic(10.0, 0.3), "neo-Hooke": NeoHookean(10.0, 0.3)}
RING = np.array([[0.0, 0.0], [1.3, 0.1], [1.1, 1.0], [0.2, 0.9]])


def model_of(cover, law, plane="strain"):
    table = parse_formulation(f"[cover]\n{COVERS[cover]}\n").cover
    return solid(
        Polygons.from_vertices([RING]), table, [LAWS[law]], plane, density=[1.0], finite=True
    )


def rows_of(model):
    rule = own_rule(model.manifold)
    points = model.manifold.rows(rule.owner, rule.points)
    return rule.points, points.matrix(model.manifold.n_unknowns).toarray()


def field(model, motion):
    """Unknowns of a displacement that the cover can hold."""
    points, rows = rows_of(model)
    return np.linalg.lstsq(rows, motion(points).ravel(), rcond=1e-12)[0]


def bent(model, seed, size=0.1):
    return size * np.random.default_rng(seed).normal(size=model.manifold.n_unknowns)


def turn(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("cover", COVERS)
def test_a_rigid_turn_by_any_angle_makes_no_force(cover, law):
    model = model_of(cover, law)
    for angle in np.radians([1e-6, 30, 90, 200]):
        still = field(model, lambda x, a=angle: x @ (turn(a) - np.eye(2)).T + [3, -2])
        answer = model.matter.update(still, {}, 0.0)
        assert np.abs(answer.stress).max() < 1e-11 * 10.0
        assert model.matter.energy(still, {}) < 1e-22


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("cover", COVERS)
def test_a_turn_of_what_is_strained_keeps_the_energy_and_turns_the_stress(cover, law):
    model, f = model_of(cover, law), np.array([[1.2, 0.1], [0.0, 0.9]])
    first = field(model, lambda x: x @ (f - np.eye(2)).T)
    known, (_, stress) = model.matter.energy(first, {}), model.matter.mean_stress(first, {})
    for angle in np.radians([30, 90, 200]):
        r = turn(angle)
        turned = field(model, lambda x, r=r: x @ (r @ f - np.eye(2)).T)
        assert model.matter.energy(turned, {}) == pytest.approx(known, rel=1e-11)
        _, now = model.matter.mean_stress(turned, {})
        tensor = r @ stress[0][[[0, 2], [2, 1]]] @ r.T
        np.testing.assert_allclose(now[0], tensor[[0, 1, 0], [0, 1, 1]], atol=1e-10)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("cover", COVERS)
def test_forces_are_the_slope_of_the_energy_and_tangents_theirs(cover, law):
    model = model_of(cover, law)
    matter, here, way, near = model.matter, 0.3 * bent(model, 0), bent(model, 1), 1e-6
    ends = [here + sign * near * way for sign in (1, -1)]
    answers = [matter.update(one, {}, 0.0) for one in (here, *ends)]
    force, *forces = [matter.force(here, one.stress) for one in answers]
    slope = (matter.energy(ends[0], {}) - matter.energy(ends[1], {})) / (2 * near)
    assert force @ way == pytest.approx(slope, rel=1e-7)
    slopes = (forces[0] - forces[1]) / (2 * near)
    tangent = matter.stiffness(answers[0].tangent)
    np.testing.assert_allclose(tangent @ way, slopes, atol=1e-6 * np.abs(slopes).max())
    # Without a deformation it is the stiffness of small strain.
    rest = matter.elastic_stiffness - model.stiffness
    assert np.abs(rest.toarray()).max() < 1e-12 * np.abs(model.stiffness.toarray()).max()


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("cover", COVERS)
def test_the_force_of_a_conserving_step_does_the_work_that_is_stored_and_no_moment(cover, law):
    model = model_of(cover, law)
    points, rows = rows_of(model)
    before, after = 0.3 * bent(model, 2), 0.3 * bent(model, 3)
    answer = model.matter.conserving(before, after)
    force = model.matter.force(after, answer.stress)
    gained = model.matter.energy(after, {}) - model.matter.energy(before, {})
    assert force @ (after - before) == pytest.approx(gained, rel=1e-10)
    middle = points + (rows @ (before + after)).reshape(-1, 2) / 2
    spin = np.linalg.lstsq(rows, (middle @ [[0, 1], [-1, 0]]).ravel(), rcond=1e-12)[0]
    assert abs(force @ spin) < 1e-11 * np.linalg.norm(force)
    near, way = 1e-6, bent(model, 4)
    ends = [model.matter.conserving(before, after + s * near * way).stress for s in (1, -1)]
    slopes = model.matter.force(after, (ends[0] - ends[1]) / (2 * near))
    tangent = model.matter.stiffness(answer.tangent, symmetric=False)
    np.testing.assert_allclose(tangent @ way, slopes, atol=1e-5 * np.abs(slopes).max())


def test_the_conserving_force_of_a_step_that_changes_nothing_is_that_of_its_start():
    model = model_of("triangles", "neo-Hooke")
    here = 0.3 * bent(model, 5)
    same = model.matter.conserving(here, here).stress
    np.testing.assert_allclose(same, model.matter.update(here, {}, 0.0).stress, atol=1e-13)
    turned = field(model, lambda x: x @ (turn(0.4) - np.eye(2)).T)
    rigid = model.matter.conserving(np.zeros_like(here), turned).stress
    assert np.abs(rigid).max() < 1e-11 * 10.0
