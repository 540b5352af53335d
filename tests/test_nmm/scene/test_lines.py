"""Line numbers of the keys of a TOML text."""

import tomllib
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from nmm.scene.lines import Path, line_numbers

TEXT = '''# comment with = and [brackets]
title = "a = [ # no comment"
"quoted.key" = 1
[materials.rock]   # table
law = "elastic"
options = { a = 1, b = [1, 2], "c d" = {e = 3} }
[[blocks]]
vertices = [
  [0, 0], [1.5, 0],   # first two
  [1, "1 m"],
]
[[blocks]]
name = """two
lines"""
material = 'rock'
[blocks.extra]
x.y = 2024-01-01T00:00:00Z
[[blocks]]
vertices = [[1, 2]]
'''


def test_every_key_path_has_its_line() -> None:
    lines = line_numbers(TEXT)
    expected: dict[Path, int] = {
        ("title",): 2,
        ("quoted.key",): 3,
        ("materials", "rock"): 4,
        ("materials", "rock", "law"): 5,
        ("materials", "rock", "options", "c d", "e"): 6,
        ("materials", "rock", "options", "b", 1): 6,
        ("blocks", 0): 7,
        ("blocks", 0, "vertices"): 8,
        ("blocks", 0, "vertices", 1): 9,
        ("blocks", 0, "vertices", 2, 1): 10,
        ("blocks", 1, "name"): 13,
        ("blocks", 1, "material"): 15,
        ("blocks", 1, "extra", "x", "y"): 17,
        ("blocks", 2, "vertices", 0, 0): 19,
    }
    assert {path: lines.get(path) for path in expected} == expected


def _paths(value: Any, path: Path = ()) -> set[Path]:
    found = {path} if path else set()
    if isinstance(value, dict):
        found |= {p for key, item in value.items() for p in _paths(item, (*path, key))}
    if isinstance(value, list):
        found |= {p for n, item in enumerate(value) for p in _paths(item, (*path, n))}
    return found


def test_the_scanner_finds_the_same_paths_as_tomllib() -> None:
    assert set(line_numbers(TEXT)) == _paths(tomllib.loads(TEXT))


VALUES = st.recursive(
    st.integers() | st.booleans() | st.text(alphabet="a=[]{}#,.'\\ \n", max_size=6),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.text(alphabet="ab.= ]", max_size=3), inner, max_size=3)
    ),
    max_leaves=8,
)


@settings(max_examples=100, deadline=None)
@given(st.dictionaries(st.text(alphabet="kv.# [", min_size=1, max_size=3), VALUES, max_size=4))
def test_the_scanner_finds_the_same_paths_in_any_text(data: dict[str, Any]) -> None:
    import tomli_w

    text = tomli_w.dumps(data)
    assert set(line_numbers(text)) == _paths(tomllib.loads(text))
