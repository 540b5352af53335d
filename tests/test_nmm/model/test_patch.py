"""Methods of support on cut meshes; patch tests and rates themselves are benchmarks A1, A2, A8."""

import pytest

from nmm.verification.problems.solids.manufactured import Waves


@pytest.mark.parametrize("formulation", ["springs", "manifold", "multipliers"])
def test_every_method_of_support_keeps_the_order(formulation: str) -> None:
    coarse, fine = (Waves().errors(formulation, h, 0)[0] for h in (1 / 8, 1 / 16))
    # At least the rate 2 of the approximation, less 0.2.
    assert fine < coarse / 2**1.8
