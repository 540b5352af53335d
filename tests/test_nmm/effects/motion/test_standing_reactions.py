"""Supports that a stage takes away leave their reactions on viscous boundaries."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing.scenes import column_on_ground

STAGES = """
[[monitors]]
name = "top"
point = [1, 4]
[[monitors]]
name = "corner"
point = [0, 0]
[[stages]]
name = "in place"
[[stages]]
name = "shaken"
supports = []
duration = 0.08
[formulation.cover]
type = "{cover}"
{cells}
[formulation.integrator]
type = "newmark"
step = 0.004
[formulation.supports]
method = "{method}"
[formulation.rotation]
update = "small"
"""


def column(incoming=False, cover="quads", method="nitsche", reactions=True, gravity=True):
    cells = "" if cover == "block" else "size = 0.9\ndegree = 1"
    stages = STAGES.format(cover=cover, cells=cells, method=method)
    return nmm.parse_scene(column_on_ground(gravity, reactions, incoming) + stages, "column.toml")


def tops(run):
    return np.array([run.history[f"monitor:{one}:u{a}"] for one in ("top", "corner") for a in "xy"])


@pytest.mark.parametrize(
    ("cover", "method"),
    [("quads", "nitsche"), ("triangles", "penalty"), ("quads", "lagrange"), ("block", "penalty")],
)
def test_a_column_under_its_weight_stays_where_it_is(cover, method):
    found = tops(nmm.run(column(cover=cover, method=method)))
    settled = 2000 * 9.81 * 4**2 / 2 / 100e6  # gamma h^2 / 2 E, about
    assert abs(found[1, 0]) > 0.5 * settled
    assert np.abs(found - found[:, :1]).max() < 1e-9 * settled


def test_without_them_it_drifts_with_its_weight_over_the_impedance_of_the_ground():
    found = tops(nmm.run(column(reactions=False)))
    assert found[3, -1] < -1e-3


def test_a_wave_moves_it_as_if_it_had_no_weight():
    heavy, light = (tops(nmm.run(column(True, gravity=gravity))) for gravity in (True, False))
    moved = heavy[:, 1:] - heavy[:, :1]
    assert np.abs(light).max() > 1e-3
    assert np.abs(moved - light[:, 1:]).max() < 1e-8 * np.abs(light).max()


def test_the_energies_of_a_shaken_column_add_up():
    row = nmm.run(column(incoming=True)).history
    stored = sum(row[f"{one}_energy"][-1] for one in ("kinetic", "strain", "support"))
    lost = row["damping_loss:viscous boundaries"][-1] + row["integration_loss"][-1]
    came = row["external_work"][-1] + row["change_energy"][-1]
    assert stored + lost == pytest.approx(came, rel=1e-8)


def test_reactions_without_stages_are_refused_by_line():
    with pytest.raises(SceneError, match=r"column\.toml:\d+.*supports that a stage takes away"):
        nmm.parse_scene("duration = 1.0\n" + column_on_ground(), "column.toml")
