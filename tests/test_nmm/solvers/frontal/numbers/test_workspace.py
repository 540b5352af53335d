"""Room for the numbers of factors."""

import pytest

from nmm.solvers.frontal.numbers import workspace
from nmm.solvers.frontal.numbers.workspace import Workspace


def test_room_without_a_user_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workspace, "SPARE_NUMBERS", 1000)
    for size in (300, 500, 800, 2000):
        one, other = Workspace(size), Workspace(size)
        del one, other
        assert sum(map(len, workspace.SPARE)) <= 1000
