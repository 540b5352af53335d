"""Expressions of x, y and t in scenes, read by a grammar of their own and never executed.

Python's parser makes a syntax tree of the text. Only the nodes, names and functions listed here are
allowed, so that no text can call, import, loop or allocate anything. Expressions are evaluated by
`nmm.effects.loading.evaluation`.
"""

from __future__ import annotations

import ast
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated

from pydantic import BeforeValidator

from nmm.errors import shown
from nmm.scene.fields import LARGEST, fault

# Largest number of characters and of nodes of an expression, and deepest nesting of brackets.
MOST_SIGNS, MOST_NODES, DEEPEST_BRACKETS = 1000, 500, 200

VARIABLES = ("x", "y", "t")
CONSTANTS = {"pi": math.pi, "e": math.e}
FUNCTIONS = {
    **dict.fromkeys(("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh"), 1),
    **dict.fromkeys(("exp", "log", "sqrt", "abs", "sign"), 1),
    **dict.fromkeys(("atan2", "hypot", "min", "max"), 2),
    "where": 3,
}
"""Number of arguments of each function."""
BINARY = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow)
COMPARED = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)


class ExpressionError(ValueError):
    """A text is no expression; tells what was found in it."""


@dataclass(frozen=True)
class Expression:
    """An expression of x, y and t.

    Attributes
    ----------
    text
        The text in the scene.
    """

    text: str

    @classmethod
    def of(cls, text: str) -> Expression:
        """Read a text.

        Raises
        ------
        ExpressionError
            It contains anything but numbers, x, y, t, pi, e, operators and the functions of the
            table.
        """
        made = cls(text)
        _check(made.tree)
        return made

    @property
    def varies(self) -> bool:
        """Whether it depends on time."""
        names = (node.id for node in ast.walk(self.tree) if isinstance(node, ast.Name))
        return "t" in names

    @cached_property
    def tree(self) -> ast.expr:
        """Syntax tree of the text."""
        if len(self.text) > MOST_SIGNS:
            raise ExpressionError(f"{len(self.text)} signs, more than {MOST_SIGNS}")
        try:
            return ast.parse(self.text.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            raise ExpressionError(str(error).split("(")[0].strip() or "no expression") from None


def _check(tree: ast.expr) -> None:
    """Refuse everything outside of the grammar."""
    if sum(1 for _ in ast.walk(tree)) > MOST_NODES:
        raise ExpressionError(f"more than {MOST_NODES} parts")
    _check_node(tree, 0)


def _check_node(node: ast.AST, depth: int) -> None:
    if depth > DEEPEST_BRACKETS:
        raise ExpressionError(f"brackets deeper than {DEEPEST_BRACKETS}")
    for part in _parts(node):
        _check_node(part, depth + 1)


def _parts(node: ast.AST) -> list[ast.expr]:
    """Return the operands of a node of the grammar."""
    match node:
        case ast.Constant(value=bool() as truth):
            raise ExpressionError(f"{truth}")
        case ast.Constant(value=int() | float() as number) if abs(number) <= LARGEST:
            return []
        case ast.Name(id=name) if name in VARIABLES or name in CONSTANTS:
            return []
        case ast.Name(id=name):
            raise ExpressionError(f'the name "{name}"')
        case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=operand):
            return [operand]
        case ast.BinOp(left=left, op=operator, right=right) if type(operator) in BINARY:
            return [left, right]
        case ast.Compare(left=left, ops=[operator], comparators=[right]):
            if type(operator) in COMPARED:
                return [left, right]
        case ast.Call(func=ast.Name(id=name), args=values, keywords=[]) if name in FUNCTIONS:
            count = FUNCTIONS[name]
            if len(values) != count:
                raise ExpressionError(f"{name} of {len(values)} values, it has {count}")
            return values
        case ast.Call(func=ast.Name(id=name)):
            raise ExpressionError(f'the function "{name}"')
    raise ExpressionError(f"{ast.unparse(node)[:40]!r}")


def _read(value: object) -> object:
    """Return two expressions as texts, or a name; refuse everything else."""
    if isinstance(value, str):
        return value
    if not isinstance(value, list | tuple) or len(value) != 2:
        expected = "two expressions of x, y, t, or the name of one of [fields.NAME]"
        raise fault(shown(value), expected, 'write for example ["1e3*x", "0"]')
    return tuple(_component(one) for one in value)


def _component(value: object) -> str:
    if isinstance(value, int | float) and not isinstance(value, bool):
        value = repr(float(value) + 0.0)
    if not isinstance(value, str):
        expected = "an expression of x, y, t"
        raise fault(shown(value), expected, 'write a text such as "1e3*x + 2*t"')
    try:
        Expression.of(value)
    except ExpressionError as error:
        allowed = f"numbers, x, y, t, pi, e, + - * / **, < >, {', '.join(FUNCTIONS)}"
        raise fault(
            f"{shown(value)}: {error}", "an expression of x, y, t", f"use {allowed}"
        ) from None
    return value


FieldOf = Annotated[tuple[str, str] | str, BeforeValidator(_read)]
"""Two expressions, or the name of a table of values."""
