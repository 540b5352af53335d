"""Solvers of other packages."""

import sys

import numpy as np
import pytest
from scipy.sparse import csc_array

from nmm.errors import FormulationError
from nmm.solvers.linear import make_solver


@pytest.mark.parametrize(("name", "package"), [("qdldl", "qdldl"), ("mumps", "python-mumps")])
def test_a_solver_that_is_not_installed_names_its_package(
    monkeypatch: pytest.MonkeyPatch, name: str, package: str
) -> None:
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(FormulationError, match=f"not installed.*package {package}"):
        make_solver(name).factorise(csc_array(np.eye(2)))
