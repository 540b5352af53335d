"""Matter that creeps and takes other constants in a stage keeps its stress and its place."""

import numpy as np
import pytest

import nmm

E1, E2, NU, ETA, PULL, LASTS = 1e9, 2e9, 0.3, 1e13, 1e5, 1e4
MORE = "delayed_modulus = 4e8\ndelayed_viscosity = 1e12\n"
LAWS = {
    "maxwell": f"viscosity = {ETA}\n",
    "kelvin": f"viscosity = {ETA}\n",
    "standard_solid": MORE,
    "burgers": f"viscosity = {ETA}\n{MORE}",
}

BAR = """plane = "{plane}"
[materials.first]
law = "{law}"
young_modulus = {e1}
poisson_ratio = {nu}
{first}
[materials.second]
law = "{law}"
young_modulus = {e2}
poisson_ratio = {nu}
{second}
[[blocks]]
name = "bar"
material = "first"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "foot"
segment = [[0, 0], [1, 0]]
fix = ["y"]
[[supports]]
name = "pin"
point = [0, 0]
fix = ["x"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [0, {pull}]
[[monitors]]
name = "end"
point = [0.5, 1]
[[stages]]
name = "creeps"
duration = {lasts}
[[stages]]
name = "other"
materials = {{ bar = "second" }}
{change}
[[stages]]
name = "creeps on"
duration = {lasts}
[[stages]]
name = "let go"
loads = []
[formulation.cover]
type = "quads"
size = 0.5
degree = 1
[formulation.integrator]
step = {step}
[formulation.supports]
method = "lagrange"
"""


def ends(law, plane, change="", second=None):
    """Ways of the end before and after the change, after more creep, and without load."""
    text = BAR.format(
        law=law, plane=plane, e1=E1, e2=E2, nu=NU, pull=PULL, lasts=LASTS, step=LASTS / 20,
        first=LAWS[law], second=second or LAWS[law], change=change,
    )  # fmt: skip
    run = nmm.run(nmm.parse_scene(text))
    assert run.summary.status == "converged", run.summary.sentence
    time, way = run.history["time"], run.history["monitor:end:uy"]
    changed = np.flatnonzero(time == LASTS)[-1]
    return way[[changed - 1, changed, -2, -1]]


@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize("law", LAWS)
def test_matter_that_creeps_stays_where_it_is_as_its_modulus_changes(law, plane):
    """The deviator of the new law was taken for that of the old strain: a third of it was lost.

    A bar of Maxwell's matter grew by 25 % of its way in the instant of the change.
    """
    before, after, _, _ = ends(law, plane)
    # An instant counts as 1e-6 of Kelvin's time, over which what is across settles.
    assert after == pytest.approx(before, rel=5e-6 if law == "kelvin" else 1e-9)


@pytest.mark.parametrize("change", ["", "cover = { size = 0.35 }"])
def test_maxwells_matter_creeps_by_the_new_viscosity_and_springs_back_by_the_new_modulus(change):
    """Of plane stress: ``q t / (3 eta)`` with each viscosity, and ``q / E`` of the second one."""
    found = ends("maxwell", "stress", change, f"viscosity = {ETA / 4}\n")
    crept = PULL * LASTS / 3 / ETA
    before = PULL / E1 + crept
    after = before + 4 * crept
    assert found == pytest.approx([before, before, after, after - PULL / E2], rel=1e-6)
