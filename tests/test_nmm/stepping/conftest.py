"""Whole runs that those which are stopped and gone on with are compared with."""

from functools import cache

import pytest

import nmm


@pytest.fixture(scope="session")
def whole(tmp_path_factory):
    """Return a function that gives the run of a text and its folder; each text is run once."""

    @cache
    def run(text):
        folder = tmp_path_factory.mktemp("whole") / "run"
        return nmm.run(nmm.parse_scene(text, "scene"), out=folder), folder

    return run
