"""Expressions of x, y, t: what they are worth, and that no text gets out of the grammar."""

import math
import time

import numpy as np
import pytest

from nmm.effects.loading.evaluation import evaluated
from nmm.scene.tables.loading.expressions import Expression, ExpressionError

POINTS = np.array([[1.0, 2.0], [-3.0, 0.5]])


@pytest.mark.parametrize(
    ("text", "function"),
    [
        ("1e3*x - 2*y/4 + t", lambda x, y, t: 1e3 * x - y / 2 + t),
        ("-x**2 + +y", lambda x, y, t: -(x**2) + y),
        ("2**-x", lambda x, y, t: 2**-x),
        ("sin(pi*t)*exp(-y) + hypot(x, y)", lambda x, y, t: math.exp(-y) + math.hypot(x, y)),
        ("where(x < 0, 1, min(y, t))", lambda x, y, t: 1 if x < 0 else min(y, t)),
        ("max(0, 10 - y) * 9810", lambda x, y, t: (10 - y) * 9810),
        ("(x >= 0) * 3", lambda x, y, t: 3 * (x >= 0)),
        ("7", lambda x, y, t: 7),
    ],
)
def test_an_expression_is_worth_what_it_says(text, function):
    found = evaluated(Expression.of(text), POINTS, 0.5)
    assert found.dtype == float
    assert found == pytest.approx([function(x, y, 0.5) for x, y in POINTS])


def test_an_expression_knows_whether_it_varies_in_time():
    assert Expression.of("x*t").varies
    assert not Expression.of("x*tan(y)").varies


# What Python would run, import, read, hang on or choke on.
ESCAPES = [
    "__import__('os').system('touch broken')",
    "().__class__.__bases__[0].__subclasses__()",
    "open('/etc/passwd').read()",
    "x.__class__",
    "x.real",
    "np.sin(x)",
    "eval('1')",
    "sin.__globals__",
    "(lambda: 1)()",
    "[x for x in (1,)]",
    "{1: 2}",
    "(1, 2)",
    "[1]",
    "'a'",
    "b'a'",
    "f'{x}'",
    "x if y else t",
    "x and y",
    "not x",
    "~x",
    "x @ y",
    "x % y",
    "x // y",
    "1 << 9",
    "x := 1",
    "x = 1",
    "x; y",
    "import os",
    "sin(*x)",
    "sin(x=1)",
    "sin(**x)",
    "sin(x, y)",
    "sin",
    "True",
    "None",
    "...",
    "1j",
    "1e400",
    "x < y < t",
    "x == y",
    "x in y",
    "z",
    "",
    "x\x00",
    "(" * 2000,
    "9" * 990,
    "-" * 900 + "x",
    "+".join(["x"] * 450),
]


@pytest.mark.parametrize("text", ESCAPES)
def test_no_text_gets_out_of_the_grammar(text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ExpressionError):
        Expression.of(text)
    assert not list(tmp_path.iterdir())


def test_towers_of_powers_are_floating_numbers_and_cost_nothing():
    begun = time.perf_counter()
    found = evaluated(Expression.of("9**9**9**9**9"), POINTS, 0.0)
    assert np.isinf(found).all()
    assert time.perf_counter() - begun < 1.0
