"""What `make bench` measures: its scenes, its ratios and its page."""

import numpy as np
import pytest

pytestmark = pytest.mark.usefixtures("benchmarks")


def test_value_at_equal_error_follows_the_power_law_between_sizes_and_ends_with_them():
    from bench_manifold import at_error
    from smooth_costs import Cost

    # Error falls with the square root of unknowns, so unknowns between are known in closed form.
    sizes = {100: 1e-1, 10_000: 1e-2}
    known = [Cost("p", "m", 1, 0, size, error, {}) for size, error in sizes.items()]
    values = [float(size) for size in sizes]
    assert at_error(known, values, 10**-1.5) == pytest.approx(1000, rel=1e-12)
    assert np.isnan(at_error(known, values, 0.2))
    assert np.isnan(at_error(known, values, 0.005))


def test_ratios_of_a_group_are_to_its_first_row_though_groups_alternate():
    from page import page

    rows = [
        {"group": group, "stats": {"min": seconds}, "extra_info": {"method": method}}
        for group, method, seconds in (("a", "one", 2.0), ("b", "two", 7.0), ("a", "three", 3.0))
    ]
    machine = {"machine": "x", "python_version": "3"}
    text = page({"machine_info": machine, "commit_info": {}, "benchmarks": rows})
    assert "| one | 2 | 1 |\n| three | 3 | 1.5 |" in text
    assert "| two | 7 | 1 |" in text


def test_cells_of_the_pile_have_three_to_six_contacts_each():
    from whole_scenes import pile

    from nmm.formulation import Formulation
    from nmm.stepping.prepare import prepare

    simulation = prepare(pile(100, 1.0), Formulation())
    found = simulation.stepper.candidates(simulation.start, 1e-6, 1e-3)
    # an edge between two cells has two contacts; by Euler a cell has six edges in the mean, less
    # those of the open top
    assert 3 <= len(found.gap) / 100 <= 6
    assert len(simulation.regions) == 103


def test_cells_with_a_gap_are_the_touching_ones_shrunk():
    from whole_scenes import pile

    from nmm.geometry.regions import regions

    touching = regions(pile(30, 1.0)).polygons.areas
    loose = regions(pile(30, 1.0, gap=0.1)).polygons.areas
    np.testing.assert_allclose(loose[:3], touching[:3], rtol=1e-12)  # the box
    np.testing.assert_allclose(loose[3:], 0.81 * touching[3:], rtol=1e-9)
