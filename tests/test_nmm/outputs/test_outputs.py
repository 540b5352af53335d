"""Outputs: the suite of all, and measures of stress against numbers of hand."""

import numpy as np
import pytest

import nmm
from nmm.outputs.base import OUTPUTS
from nmm.outputs.stresses import principal, von_mises
from nmm.testing import check_output
from nmm.testing.outputs import TWO_BLOCKS


@pytest.mark.parametrize("name", OUTPUTS.names())
def test_an_output_keeps_what_every_one_promises(name):
    check_output(OUTPUTS.make(name))


def test_measures_of_simple_states_of_stress():
    # Pull, equal pull, pure shear: f, f, sqrt(3) f (von Mises in plane stress).
    stress = np.array([[3.0, 0.0, 0.0], [3.0, 3.0, 0.0], [0.0, 0.0, 3.0]])
    np.testing.assert_allclose(von_mises(stress), [3.0, 3.0, 3.0 * 3**0.5], rtol=1e-15)
    np.testing.assert_allclose(principal(stress), [[3, 0], [3, 3], [3, -3]], atol=1e-15)


def test_what_outputs_read_changes_no_digit_of_a_run():
    names = ", ".join(f'"{name}"' for name in OUTPUTS.names())
    plain = nmm.run(nmm.parse_scene(TWO_BLOCKS))
    read = nmm.run(nmm.parse_scene(f"{TWO_BLOCKS}[output]\nquantities = [{names}]\n"))
    for name, column in plain.history.items():
        assert np.array_equal(read.history[name], column)
    assert set(read.history) - set(plain.history) == {"crack_opening"}
    assert set(read.frames[-1].fields) == set(OUTPUTS.names())
