"""Bands of flow are told where they are possible, and only there."""

import re

import pytest

import nmm
from nmm.testing.resumed.stopping import check_resumed
from nmm.testing.scenes import biaxial_test

SMALL = '[formulation.rotation]\nupdate = "small"\n'


def pressed(dilation, more=SMALL):
    return nmm.run(nmm.parse_scene(biaxial_test(dilation, more))).summary


def test_soil_that_dilates_less_than_its_friction_is_said_to_strain_in_bands():
    """Along 45 degrees and (30 + 0) / 4 from the side about: ``cos 2 theta = sin(30) / 2``.

    The tangent of a long step turns by some degrees more; within 45 and half of 30 it stays.
    """
    found = pressed(0)
    (told,) = [line for line in found.warnings if "(audit ellipticity)" in line]
    band = float(re.search(r"along (\d+) degrees", told)[1])
    assert min(abs(band - 52.2), abs(180 - band - 52.2)) < 4
    # At most (sin 30)^2 / 8 / (1 - nu), of steps without length.
    assert 0.01 < found.audits["ellipticity"] < 0.25 / 8 / 0.75 * 1.001


def test_associated_flow_is_not():
    found = pressed(30)
    assert found.audits["ellipticity"] == pytest.approx(0, abs=1e-9)
    assert "(audit ellipticity)" not in " ".join(found.warnings)


def test_soil_that_stays_elastic_is_not_asked():
    text = biaxial_test(0, SMALL).replace("-0.02]", "-0.0001]")
    assert "ellipticity" not in nmm.run(nmm.parse_scene(text)).summary.audits


def test_a_run_that_goes_on_from_its_last_step_is_asked_too(tmp_path):
    """Its steps are spent: nothing is left to solve, and where the last one began is asked."""
    stores = "[output]\ncheckpoint = { every_steps = 1 }\n[formulation.loading]\nmax_steps = 5\n"
    scene = nmm.parse_scene(biaxial_test(0, SMALL + stores))
    whole = nmm.run(scene, out=tmp_path / "run")
    assert whole.summary.status == "budget_spent"
    assert whole.summary.audits["ellipticity"] > 0.01
    check_resumed(whole, nmm.resume(tmp_path / "run"))
