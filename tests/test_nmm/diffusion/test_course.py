"""Steps in time of scalar fields: orders, stability, and what trying a step leaves behind."""

from dataclasses import replace

import numpy as np
import pytest

from covers.scalar.space import ScalarSpace
from nmm.assembly.places import on_edges
from nmm.diffusion.course import FieldAt, FieldCourse
from nmm.diffusion.given import VolumeSource
from nmm.diffusion.holding import prescribed
from nmm.diffusion.matrices import products, slopes
from nmm.diffusion.problem import DiffusionProblem, field_solver
from nmm.effects.loading.load_factor import steadily
from nmm.formulation import CoverTable, Solver
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.verification.continuum import polygon
from nmm.verification.text import rectangle


def course(theta, step=None):
    """A unit square held at zero all around, that starts as one everywhere."""
    cover = CoverTable(type="quads", size=0.25, functions="monomials", degree=1)
    model = solid(polygon(rectangle((0, 0), (1, 1))), cover, [Elastic(1.0, 0.2)], "stress")
    space, ones = ScalarSpace.of(model.manifold), np.ones(len(model.density))
    place = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 6)
    alike = np.tile(np.eye(2), (len(ones), 1, 1))
    rim = prescribed(space, model, alike, place, np.zeros(len(place)), "rim")
    solver = field_solver(model.manifold, Solver())
    problem = DiffusionProblem(
        space, slopes(space, alike), products(space, ones), [rim], [], [], solver
    )
    return FieldCourse(problem, FieldAt(0.0, space.one, {}), theta, step)


@pytest.mark.parametrize(("theta", "order"), [(0.5, 2.0), (1.0, 1.0)])
def test_what_is_stored_converges_in_time_with_the_order_of_theta(theta, order):
    stored = [course(theta, 0.1 / n).at(0.1).stored for n in (8, 16, 32, 64)]
    exact = course(0.5, 0.1 / 512).at(0.1).stored
    errors = np.abs(np.array(stored) - exact)
    assert np.log2(errors[:-1] / errors[1:])[-1] == pytest.approx(order, abs=0.25)
    # The series of the square: 64 / pi^4 sum exp(-(m^2 + n^2) pi^2 t) / (m n)^2 over odd m, n.
    odd = np.arange(1, 60, 2)
    one = (np.exp(-(odd**2) * np.pi**2 * 0.1) / odd**2).sum()
    assert 1 + exact == pytest.approx(64 / np.pi**4 * one**2, abs=2e-3)


def even(source):
    """The square insulated, one everywhere, with so much given to every volume."""
    found = course(1.0)
    problem, one = found.problem, found.problem.space.one
    load = VolumeSource("source", source * (problem.capacity @ one), steadily)
    problem = replace(problem, edges=[], sources=[load] if source else [])
    return FieldCourse(problem, FieldAt(0.0, one, {}))


def test_an_even_field_that_nothing_loads_is_not_solved_again(monkeypatch):
    still = even(0.0)
    monkeypatch.setattr(DiffusionProblem, "stepped", None)
    assert still.at(1e3).unknowns is still.began.unknowns
    assert still.at(1e3).time == 1e3


def test_a_source_far_below_the_rounding_of_what_flows_to_and_fro_adds_up():
    one = even(0.0).problem.space.one
    rise = even(1e-12).at(1e3).unknowns[one == 1] - 1
    # 1e-9 in numbers about 1, whose rounding grows by the conduction in a step, 1e3.
    np.testing.assert_allclose(rise, 1e-9, rtol=1e-2)


@pytest.mark.parametrize("theta", [0.5, 0.75, 1.0])
def test_no_step_is_too_long(theta):
    at = course(theta, 1e6).at(2e7)
    assert np.abs(at.unknowns).max() <= 1.0
    assert at.imbalance < 1e-10


def test_a_step_that_is_tried_again_does_not_see_what_was_tried_before():
    tried, straight = course(0.5), course(0.5)
    tried.begin(0.0)
    tried.at(0.1)
    tried.at(0.025)
    half = tried.at(0.05)
    assert np.array_equal(half.unknowns, straight.at(0.05).unknowns)
    for one in (tried, straight):
        one.begin(0.05)
    assert np.array_equal(tried.at(0.1).unknowns, straight.at(0.1).unknowns)
